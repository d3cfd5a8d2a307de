// `ninebit bench raster`: triangles and pixels a second, depth test and flat colour.
#include <fmt/format.h>

#include <memory>
#include <optional>

#include "src/bench/raster_rate.h"
#include "src/tools/bench.h"
#include "src/tools/scene_flags.h"

namespace ninebit::tools {
namespace {

struct Workload {
  std::string name;
  float leg;  // pixels; 0: large triangles
};

struct Row {
  std::string workload;
  int threads = 1;
  double mtriangles_per_s = 0.0, mpixels_per_s = 0.0;
  std::size_t triangles = 0;
  std::uint64_t covered_pixels = 0;
};

struct Size {
  int width, height;
};

// The rows of one workload, one and all threads.
Status measure(const BenchFlags& flags, const Workload& workload, const Size& size, double done, ProgressLine& line,
               std::vector<Row>& rows) {
  const bench::Mesh mesh =
      workload.leg > 0.0F ? bench::small_triangles(size.width, size.height, workload.leg) : bench::large_triangles();
  const auto covered = bench::covered_pixels(mesh, size.width, size.height);
  if (!covered) return covered.error();
  auto surface = Surface::make(size.width, size.height);
  if (!surface) return surface.error();
  for (const int threads : one_and_all_threads(flags.common)) {
    if (!line.step(workload.name, done)) return Diagnostic{.message = "interrupted", .fault = Fault::cancelled};
    const ThreadLimit limit(threads);
    const auto seconds = bench::seconds_to_draw(mesh, *surface, flags.time_limit());
    if (!seconds) return seconds.error();
    rows.push_back({workload.name, threads, static_cast<double>(mesh.triangles.size()) / *seconds / 1e6,
                    static_cast<double>(*covered) / *seconds / 1e6, mesh.triangles.size(), *covered});
  }
  return {};
}

std::string table(const std::vector<Row>& rows) {
  std::string text = fmt::format("{:<9} {:>7} {:>12} {:>10} {:>10} {:>12}\n", "workload", "threads", "Mtriangle/s",
                                 "Mpixel/s", "triangles", "pixels");
  for (const Row& r : rows) {
    text += fmt::format("{:<9} {:>7} {:>12.3f} {:>10.1f} {:>10} {:>12}\n", r.workload, r.threads, r.mtriangles_per_s,
                        r.mpixels_per_s, r.triangles, r.covered_pixels);
  }
  return text;
}

int bench_raster(const BenchFlags& flags) {
  const Size size = flags.quick ? Size{128, 96} : Size{1024, 768};
  const std::vector<Workload> workloads{{"legs-1", 1.0F}, {"legs-4", 4.0F}, {"legs-16", 16.0F}, {"large", 0.0F}};
  std::optional<ProgressLine> line(std::in_place, flags.common.quiet);
  std::vector<Row> rows;
  for (std::size_t i = 0; i < workloads.size(); ++i) {
    const double done = static_cast<double>(i) / static_cast<double>(workloads.size());
    if (Status measured = measure(flags, workloads[i], size, done, *line, rows); !measured) {
      return line.reset(), report(measured.error());
    }
  }
  line.reset();
  if (!flags.common.json) return answer(table(rows));
  Json list = Json::array();
  for (const Row& r : rows) {
    list.push_back({{"workload", r.workload},
                    {"threads", r.threads},
                    {"mtriangles_per_s", r.mtriangles_per_s},
                    {"mpixels_per_s", r.mpixels_per_s},
                    {"covered_pixels", r.covered_pixels},
                    {"triangles", r.triangles}});
  }
  const Json out{{"command", "bench raster"},
                 {"version", NINEBIT_VERSION},
                 {"profile", flags.common.profile},
                 {"size", {size.width, size.height}},
                 {"rows", std::move(list)}};
  return answer(out.dump(2) + "\n");
}

}  // namespace

void add_bench_raster(CLI::App& bench, int& exit_code) {
  CLI::App* verb = bench.add_subcommand("raster", "Triangles and pixels a second, depth-tested and flat");
  verb->footer("Example: ninebit bench raster --threads 2 --json");
  auto flags = std::make_shared<BenchFlags>();
  add_bench_flags(*verb, *flags);
  verb->callback([flags, &exit_code] { exit_code = bench_raster(*flags); });
}

}  // namespace ninebit::tools
