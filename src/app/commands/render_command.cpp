// SPDX-License-Identifier: Apache-2.0
// A picture of the map from any view.
#include <cstdio>
#include <memory>
#include <thread>

#include "app/commands/commands.h"
#include "app/commands/render/options.h"
#include "app/commands/render/picture_file.h"
#include "app/console.h"
#include "app/interrupt.h"
#include "app/option_values.h"
#include "core/error.h"
#include "gpu/device.h"
#include "index/catalogue.h"
#include "pipeline/project.h"
#include "pipeline/tbb_executor.h"
#include "raster/crs.h"
#include "render/legend.h"
#include "render/map_scene.h"

namespace skysweep::app {
namespace {

// What a cell takes with all that is made of it, a pixel until it is encoded, and the program with a band of rays.
constexpr std::size_t kBytesPerCell = 64, kBytesPerPixel = 16, kBytesPerLayeredPixel = 72;
constexpr std::size_t kBytesBeside = std::size_t{320} << 20;

std::int64_t cells_that_fit(const RenderOptions& options, render::PictureSize size) {
  const std::size_t allowed = parse_memory(options.memory);
  const std::size_t a_pixel = options.kind() == PictureKind::exr ? kBytesPerLayeredPixel : kBytesPerPixel;
  const std::size_t taken = kBytesBeside + a_pixel * static_cast<std::size_t>(size.width_px) * size.height_px;
  if (allowed <= taken)
    throw Error(ErrorKind::memory_plan, "a picture of " + std::to_string(size.width_px) + " x " +
                                            std::to_string(size.height_px) + " pixels alone takes " +
                                            memory_text(taken) + ": allow more with --memory, or ask for less.");
  return static_cast<std::int64_t>((allowed - taken) / kBytesPerCell);
}

std::vector<camera::Camera> cameras_of(const std::vector<index::ImageRecord>& images) {
  std::vector<camera::Camera> cameras;
  for (const index::ImageRecord& image : images)
    if (image.status == index::ImageStatus::used) cameras.emplace_back(image.model, image.pose);
  return cameras;
}

// What casts the rays, and the device that it may be on.
struct Caster {
  std::unique_ptr<gpu::Device> device;
  std::unique_ptr<render::Tracer> tracer;
};

// `auto` takes a real GPU if there is one that can hold the map; `gpu` also Mesa's rasteriser on the CPU, and throws
// where there is neither.
Caster make_caster(RenderBackend backend, const render::RayCaster& surface, Executor& executor, Console& console) {
  Caster caster;
  caster.tracer = render::make_cpu_tracer(surface, executor);
  if (backend == RenderBackend::cpu || (backend == RenderBackend::automatic && !gpu::Device::lists_real_gpu()))
    return caster;
  try {
    caster.device = gpu::Device::open();
    console.say("Rays are cast by " + caster.device->name() + ".");
    caster.tracer = render::with_fallback(
        render::make_gpu_tracer(surface, *caster.device), std::move(caster.tracer), [&console](const std::string& why) {
          console.warn("The GPU failed (" + why + "); the picture goes on without it.");
        });
  } catch (const gpu::DeviceError& error) {
    if (backend == RenderBackend::gpu)
      throw failure(std::string(error.what()) + " Take --backend cpu, or auto, which does without.");
    console.warn("The GPU cannot be used (" + std::string(error.what()) + "); the picture is made without it.");
    caster.device.reset();
  }
  return caster;
}

struct Drawn {
  Array2d<Rgb8> picture;
  std::optional<render::PictureLayers> layers;
};

// Nothing if Ctrl-C stopped it.
std::optional<Drawn> draw(const RenderOptions& options, const render::MapScene& scene, const render::View& view,
                          const std::vector<index::ImageRecord>& images, Executor& executor, Console& console) {
  const render::LookOptions look = options.look_options();
  std::optional<render::ViewCounts> counts;
  if (look.look == render::Look::views) counts.emplace(cameras_of(images), scene.true_bounds());
  const render::Shading shading(scene, look, view, counts ? &*counts : nullptr);
  const render::RayCaster surface(scene.field(), options.surface_form());
  const Caster caster = make_caster(options.chosen_backend(), surface, executor, console);
  console.begin("render", 100);
  int done = 0;
  const auto on_band = [&](double share) {
    for (; done < static_cast<int>(100 * share + 1e-6); ++done) console.advance();
    return !interrupt_requested();
  };
  Drawn drawn{render::draw_picture(view, shading, look, options.picture_options(), *caster.tracer, executor, on_band),
              {}};
  if (interrupt_requested()) return std::nullopt;
  if (options.kind() == PictureKind::exr)
    drawn.layers = render::draw_layers(view, shading, scene.drawn_bounds().min, *caster.tracer, executor);
  else if (look.legend && shading.scale())
    render::draw_legend(*shading.scale(), drawn.picture);
  return drawn;
}

void say_result(const RenderOptions& options, const render::MapScene& scene, render::PictureSize size,
                const std::string& crs_wkt, Console& console) {
  char text[160];
  std::snprintf(text, sizeof text, "%s, %d x %d pixels, of the map's level %d with cells of %.9g m",
                options.look.c_str(), size.width_px, size.height_px, scene.map_level(), scene.field()->cell_m);
  console.say(options.output + ": " + text + ". CRS: " + raster::crs_name(crs_wkt) + ".");
}

int render_map(const RenderOptions& options) {
  options.check();
  const pipeline::ProjectPaths paths(options.project);
  if (!pipeline::project_exists(paths))
    throw bad_input(options.project + " holds no project (project.toml is missing).");
  Console console(options.json_log);
  const pipeline::ProjectSettings settings = pipeline::read_project(paths);
  const tiles::TileStore store = pipeline::open_store(paths, settings);
  const std::vector<index::ImageRecord> images = index::Catalogue::open_existing(paths.catalogue()).images();
  const render::PictureSize size = options.picture_size(images);
  const std::optional<Box2d> area = options.area ? std::optional(parse_area(*options.area)) : std::nullopt;
  const render::MapScene scene(render::read_map_window(store, area, cells_that_fit(options, size)),
                               options.exaggeration);
  const render::View view = options.chosen_view(scene.drawn_bounds(), images);
  pipeline::TbbExecutor executor(options.threads.value_or(static_cast<int>(std::thread::hardware_concurrency())));
  interrupt_requested();  // from here on Ctrl-C stops between two bands
  const std::optional<Drawn> drawn = draw(options, scene, view, images, executor, console);
  if (!drawn) {
    console.say("Interrupted. Nothing was written.");
    return kExitInterrupted;
  }
  if (drawn->layers)
    write_layers(options.output, drawn->picture, *drawn->layers,
                 {{"software", pipeline::software_name()}, {"crs", settings.crs_wkt}, {"units", "metre"}});
  else
    write_picture(options.output, options.kind(), options.quality_or_default(), drawn->picture);
  say_result(options, scene, size, settings.crs_wkt, console);
  return 0;
}

}  // namespace

void add_render_command(CLI::App& program, ChosenCommand& chosen) {
  CLI::App* command = program.add_subcommand("render", "A picture of the map from any view; needs no display.");
  auto o = std::make_shared<RenderOptions>();
  command->add_option("PROJECT", o->project, "Project folder")->required();
  command->add_option("-o,--output", o->output, "Picture to make: .png, .jpg, .webp, or .exr with layers; is replaced")
      ->required();
  command->add_option("--look", o->look, "orthophoto (default), hillshade, relief, slope, confidence, views or level");
  command->add_option("--view", o->view, "overview (default), north, top or oblique: views of the whole map");
  command->add_option("--eye", o->eye, "E,N,H: where the camera stands, in map coordinates");
  command->add_option("--target", o->target, "E,N,H: the place that it looks at");
  command->add_option("--photo", o->photo, "The view of this photograph, with its own camera and lens distortion");
  command->add_option("--fov", o->fov_deg, "Angle across the width of the picture in degrees (default 45)");
  command->add_flag("--orthographic", o->orthographic, "Parallel projection");
  command->add_option("--size", o->size, "WIDTHxHEIGHT in pixels (default 1280x720, or the photograph's)");
  command->add_option("--aoi", o->area, "Only x0,y0,x1,y1 of the map, in its CRS");
  command->add_option("--sun", o->sun,
                      "AZIMUTH,ELEVATION in degrees, clockwise from north (default: over the left shoulder)");
  command->add_flag("--shadows", o->shadows, "Cast shadows");
  command->add_option("--exaggeration", o->exaggeration, "Factor on heights above the map's lowest (default 1)");
  command->add_option("--relief-range", o->relief_range, "LOW,HIGH: heights at the ends of the relief's colours");
  command->add_option("--surface", o->surface, "bilinear (default), or boxes: every cell level, with upright walls");
  command->add_option("--samples", o->samples, "Rays a pixel, this number squared (default 2)");
  command->add_flag("--exact", o->exact, "Cast every ray down to the surface, however small it is in the picture");
  command->add_option("--background", o->background, "Colour where there is no map, RRGGBB");
  command->add_flag("--no-legend", o->no_legend, "No legend");
  command->add_option("--quality", o->quality, "Of .jpg and .webp, 1 to 100 (default 90; webp 100 is lossless)");
  command->add_option("--memory", o->memory,
                      "Most memory to use (default 2GiB): larger maps are drawn at a coarser level");
  command->add_option("--threads", o->threads, "Number of threads (default: all)");
  command->add_option("--backend", o->backend,
                      "auto (default: gpu if the machine has a real one, else cpu), cpu or gpu");
  command->add_flag("--json-log", o->json_log, "One JSON object a line instead of text");
  command->callback([o, &chosen] { chosen = [o] { return render_map(*o); }; });
}

}  // namespace skysweep::app
