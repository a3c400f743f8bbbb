// SPDX-License-Identifier: Apache-2.0
#include "pipeline/open_project.h"

#include <sstream>

#include "core/error.h"
#include "pipeline/ground_estimate.h"
#include "raster/atomic_file.h"
#include "raster/crs.h"
#include "settings/preset.h"

namespace skysweep::pipeline {
namespace {

std::string number(double value) {
  std::ostringstream out;
  out.precision(15);
  out << value;
  return out.str();
}

[[noreturn]] void contradiction(const ProjectPaths& paths, const std::string& what, const std::string& has,
                                const std::string& asked) {
  throw usage_error("The project " + paths.folder.string() + " was made with " + what + " " + has +
                    ", and this run asks for " + asked +
                    ": leave the option out, choose another folder with -o, or start over with --fresh.");
}

Configuration requested_configuration(const RunRequest& request) {
  Configuration configuration =
      read_configuration(request.preset.value_or(std::string(settings::kDefaultPreset)), request.config);
  if (request.no_fill) configuration.sweep.fill = false;
  if (request.planar_fallback) configuration.sweep.planar_fallback = true;
  return configuration;
}

// The first line in which two texts of equal structure differ.
void require_same_configuration(const Configuration& has, const Configuration& asked, const ProjectPaths& paths) {
  std::istringstream a(configuration_text(has)), b(configuration_text(asked));
  for (std::string line_a, line_b, section; std::getline(a, line_a) && std::getline(b, line_b);) {
    if (line_a.starts_with('[')) section = line_a;
    if (line_a != line_b) contradiction(paths, section, line_a, line_b);
  }
}

void require_no_contradiction(const RunRequest& request, const ProjectSettings& project, const ProjectPaths& paths) {
  if (request.crs) {
    const std::string asked = raster::crs_from_user_input(*request.crs);
    if (!raster::same_crs(asked, project.crs_wkt))
      contradiction(paths, "the CRS", raster::crs_name(project.crs_wkt), raster::crs_name(asked));
  }
  if (request.cell_m && *request.cell_m != project.lattice.cell_m)
    contradiction(paths, "--cell", number(project.lattice.cell_m), number(*request.cell_m));
  if (request.dz_m && *request.dz_m != project.lattice.dz_m)
    contradiction(paths, "--dz", number(project.lattice.dz_m), number(*request.dz_m));
  if (request.backend && *request.backend != project.backend)
    contradiction(paths, "--backend", sweep::to_string(project.backend), sweep::to_string(*request.backend));
  if (request.heights) {
    const auto text = [](const sweep::HeightRange& r) { return number(r.z_low) + "," + number(r.z_high); };
    const std::string has = project.search.heights ? text(*project.search.heights) : "none";
    if (has != text(*request.heights)) contradiction(paths, "--z-range", has, text(*request.heights));
  }
  if (request.preset || request.config)
    require_same_configuration(project.configuration, requested_configuration(request), paths);
  if (request.no_fill && project.configuration.sweep.fill) contradiction(paths, "fill", "true", "--no-fill");
  if (request.planar_fallback && !project.configuration.sweep.planar_fallback)
    contradiction(paths, "planar_fallback", "false", "--planar-fallback");
}

}  // namespace

ProjectChoice choose_project(const RunRequest& request, const ProjectPaths& paths) {
  if (project_exists(paths) && !request.fresh) {
    const ProjectSettings existing = read_project(paths);
    require_no_contradiction(request, existing, paths);
    return {existing.configuration, existing};
  }
  if (!request.dry_run) raster::require_writable_folder(paths.folder);
  return {requested_configuration(request), std::nullopt};
}

namespace {

void choose_engine(const RunRequest& request, ProjectSettings& project, Progress& progress) {
  project.backend = request.backend ? *request.backend : sweep::default_backend();
  if (const auto reason = sweep::why_not_on_gpu(project.configuration.sweep);
      reason && project.backend == sweep::Backend::gpu) {
    if (request.backend) throw usage_error(*reason + ". Use --backend cpu.");
    progress.note(*reason + ": the cpu backend takes its place.");
    project.backend = sweep::Backend::cpu;
  }
  if (project.backend == sweep::Backend::cpu) project.instruction_set = sweep::cpu_instruction_set_in_use();
  if (project.backend != sweep::Backend::gpu) return;
  sweep::GpuDevice device;
  try {
    device = sweep::gpu_device();
  } catch (const Error& error) {
    throw failure(std::string(error.what()) + " Use --backend cpu.");
  }
  project.gpu_device = device.name;
  if (device.is_software)
    progress.warn("The gpu backend runs on a software device (" + device.name +
                  "): this machine has no GPU that OpenGL 4.5 can use. --backend cpu is many times faster.");
  else
    progress.note("GPU: " + device.name + ".");
}

}  // namespace

ProjectSettings new_project_settings(const RunRequest& request, const Configuration& configuration,
                                     const std::vector<index::ImageRecord>& records, PhotoCache& photos,
                                     Executor& executor, Progress& progress) {
  ProjectSettings project;
  project.images = std::filesystem::absolute(request.images).lexically_normal();
  project.configuration = configuration;
  project.crs_wkt = request.crs ? raster::crs_from_user_input(*request.crs) : raster::local_metric_crs();
  choose_engine(request, project, progress);
  progress.begin("looking for the ground", 1);
  project.search = estimate_search_range(records, request.heights, photos, executor);
  progress.advance();
  project.lattice.tile_cells = configuration.tiles.cells;
  project.lattice.cell_m = request.cell_m.value_or(default_cell(records, project.search));
  project.lattice.dz_m =
      request.dz_m.value_or(default_plane_step(records, project.search, configuration.sweep.plane_step_px));
  progress.note("The ground is about " + number(std::round(project.search.ground_depth_m * 10) / 10) +
                " m below the cameras; cells of " + number(project.lattice.cell_m) + " m, plane step " +
                number(project.lattice.dz_m) + " m.");
  return project;
}

void make_project(const ProjectPaths& paths, const ProjectSettings& settings, bool fresh) {
  raster::require_writable_folder(paths.folder);
  if (fresh) {
    // The settings last, by being replaced: whatever a crash leaves is the old project, less some of its tiles.
    std::filesystem::remove_all(paths.tiles());
    std::filesystem::remove(paths.catalogue());
    std::filesystem::remove(paths.removals());
  }
  write_project(paths, settings);
}

namespace {

void require_recorded_device(const std::string& recorded) {
  const std::string project = "This project was made by the gpu backend on " + recorded;
  const std::string remedy = ": its tiles could not be continued bit for bit. Start over with --fresh.";
  std::string here;
  try {
    here = sweep::gpu_device().name;
  } catch (const Error& error) {
    throw failure(project + remedy + " " + error.what());
  }
  if (here != recorded) throw failure(project + ", and the device here is " + here + remedy);
}

void require_recorded_instruction_set(const std::string& recorded) {
  if (sweep::cpu_instruction_set_in_use() == recorded) return;
  try {
    sweep::use_cpu_instruction_set(recorded);
  } catch (const Error&) {
    throw failure("This project was made with the instruction set " + recorded +
                  ", which this machine lacks: its tiles could not be continued bit for bit. Start over with --fresh.");
  }
}

}  // namespace

void use_recorded_engine(const ProjectSettings& settings) {
  switch (settings.backend) {
    case sweep::Backend::reference: return;
    case sweep::Backend::cpu: return require_recorded_instruction_set(settings.instruction_set);
    case sweep::Backend::gpu: return require_recorded_device(settings.gpu_device);
  }
}

}  // namespace skysweep::pipeline
