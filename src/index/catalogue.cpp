// SPDX-License-Identifier: Apache-2.0
#include "index/catalogue.h"

#include <unistd.h>

#include <algorithm>
#include <utility>

#include "core/error.h"
#include "index/catalogue/geopackage.h"
#include "index/catalogue/image_rows.h"
#include "index/catalogue/product_rows.h"
#include "index/catalogue/schema.h"
#include "index/catalogue/tile_rows.h"

namespace skysweep::index {
namespace {

Error cannot_write(const std::filesystem::path& path, const std::string& why) {
  return failure("cannot write the catalogue " + path.string() + " (" + why +
                 "): see that its folder is writable, the disk has space and no other program holds the file");
}

Error damaged(const std::filesystem::path& path, const std::string& why) {
  return bad_input("the catalogue " + path.string() + " cannot be used: " + why +
                   "; move the file away and run again to make a new one");
}

// Under another name first, so that a file that is found is always whole.
void make_file(const std::filesystem::path& path, const std::string& crs_wkt) {
  const QuietGdal gdal;
  const OGRSpatialReference crs = catalogue_crs(crs_wkt);
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GPKG");
  if (!driver) throw failure("this GDAL was built without GeoPackage (SQLite); install one that has it");
  std::filesystem::path unfinished = path;
  unfinished.replace_extension(".unfinished.gpkg");
  std::error_code error;
  std::filesystem::remove(unfinished, error);  // of a run that was interrupted
  DatasetPtr dataset(driver->Create(unfinished.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
  if (dataset) make_layers(*dataset, crs);
  dataset.reset();
  if (!gdal.first_failure().empty()) {
    std::filesystem::remove(unfinished, error);
    throw cannot_write(path, gdal.first_failure());
  }
  std::filesystem::rename(unfinished, path, error);
  if (error) throw cannot_write(path, error.message());
}

// What SQLite finds wrong with its pages; empty if nothing.
std::string what_is_broken(GDALDataset& dataset) {
  std::string verdict;
  for_each_row(dataset, "PRAGMA quick_check(1)", [&](const OGRFeature& row) { verdict = row.GetFieldAsString(0); });
  return verdict == "ok" ? "" : "its pages do not fit together (" + verdict + ")";
}

DatasetPtr open_file(const std::filesystem::path& path, unsigned access) {
  const QuietGdal gdal;
  const char* const drivers[] = {"GPKG", nullptr};
  DatasetPtr dataset(GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR | access, drivers, nullptr, nullptr));
  if (!gdal.first_failure().empty()) throw damaged(path, gdal.first_failure());
  if (!dataset) throw damaged(path, "it is no GeoPackage");
  if (const std::string missing = what_is_missing(*dataset); !missing.empty()) throw damaged(path, "it " + missing);
  const std::string broken = what_is_broken(*dataset);
  if (!gdal.first_failure().empty()) throw damaged(path, gdal.first_failure());
  if (!broken.empty()) throw damaged(path, broken);
  return dataset;
}

}  // namespace

struct Catalogue::Impl {
  std::filesystem::path path;
  DatasetPtr dataset;

  // Does all of `change` or, if any of it fails, nothing.
  template <typename Change>
  void write(Change change) {
    const QuietGdal gdal;
    Transaction transaction(*dataset);
    change(*dataset);
    if (gdal.first_failure().empty()) transaction.commit();
    if (!gdal.first_failure().empty()) throw cannot_write(path, gdal.first_failure());
  }

  // What `rows` gives, by name.
  template <typename Rows>
  auto read(Rows rows) const {
    const QuietGdal gdal;
    try {
      auto records = rows(*dataset);
      if (!gdal.first_failure().empty()) throw bad_input(gdal.first_failure());
      std::sort(records.begin(), records.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
      return records;
    } catch (const Error& error) {
      throw damaged(path, error.what());
    }
  }

  ~Impl() {
    const QuietGdal gdal;  // a file that vanished meanwhile is no reason to print
    dataset.reset();
  }
};

Catalogue::Catalogue(const std::filesystem::path& path, const std::string& crs_wkt) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) make_file(path, crs_wkt);
  impl_.reset(new Impl{path, open_file(path, GDAL_OF_UPDATE)});
}
Catalogue::Catalogue(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

Catalogue Catalogue::open_existing(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) throw bad_input("the catalogue " + path.string() + " is missing");
  // What a crash left in the journal can only be undone by one who may write.
  const bool writable = ::access(path.c_str(), W_OK) == 0;
  return Catalogue(std::unique_ptr<Impl>(new Impl{path, open_file(path, writable ? GDAL_OF_UPDATE : 0u)}));
}
Catalogue::~Catalogue() = default;
Catalogue::Catalogue(Catalogue&&) noexcept = default;
Catalogue& Catalogue::operator=(Catalogue&&) noexcept = default;

void Catalogue::put_images(const std::vector<ImageRecord>& images) {
  impl_->write([&](GDALDataset& dataset) {
    put_image_rows(dataset, images);
    remove_unused_cameras(dataset);
  });
}

void Catalogue::remove_images(const std::vector<std::string>& names) {
  impl_->write([&](GDALDataset& dataset) {
    remove_rows(dataset, "images", names);
    remove_unused_cameras(dataset);
  });
}

std::vector<ImageRecord> Catalogue::images() const { return impl_->read(image_rows); }

void Catalogue::put_tiles(const std::vector<TileRecord>& tiles) {
  impl_->write([&](GDALDataset& dataset) { put_tile_rows(dataset, tiles); });
}

void Catalogue::remove_tiles(const std::vector<std::string>& names) {
  impl_->write([&](GDALDataset& dataset) { remove_rows(dataset, "tiles", names); });
}

std::vector<TileRecord> Catalogue::tiles() const { return impl_->read(tile_rows); }

void Catalogue::put_products(const std::vector<ProductRecord>& products) {
  impl_->write([&](GDALDataset& dataset) { put_product_rows(dataset, products); });
}

void Catalogue::remove_products(const std::vector<std::string>& names) {
  impl_->write([&](GDALDataset& dataset) { remove_rows(dataset, "products", names); });
}

std::vector<ProductRecord> Catalogue::products() const { return impl_->read(product_rows); }

}  // namespace skysweep::index
