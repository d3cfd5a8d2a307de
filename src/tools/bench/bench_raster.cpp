// `ninebit bench raster`: triangles and pixels per second with depth test and flat colour; with --growth, how time and
// memory grow with the number of triangles.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "src/bench/llvmpipe_mesh.h"
#include "src/bench/raster_rate.h"
#include "src/bench/timing.h"
#include "src/tools/bench/bench.h"
#include "src/tools/common/scene_flags.h"

namespace ninebit::tools {
namespace {

struct Workload {
  std::string name;
  float leg;  // pixels; 0: large triangles
};

struct RasterRow {
  std::string workload;
  int threads = 1;
  double mtriangles_per_s = 0.0, mpixels_per_s = 0.0;
  std::size_t triangles = 0;
  std::uint64_t covered_pixels = 0;
  std::optional<double> rival_mtriangles_per_s{};  // on as many threads
  std::size_t pixels_that_differ = 0;              // between our picture and the rival's
  std::optional<double> memset_gb_per_s{};         // of `large`, on as many threads

  // Colour and depth of every covered pixel: what passes the depth test of `large`.
  [[nodiscard]] double written_gb_per_s() const { return 8e-3 * mpixels_per_s; }
};

struct RasterFlags {
  BenchFlags bench;
  bool growth = false;
  std::string rival;
};

struct Size {
  int width, height;
};

std::size_t pixels_that_differ(const Surface& ours, const std::vector<std::uint8_t>& theirs) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < theirs.size() / 4; ++i) {
    bool same = true;
    for (std::size_t c = 0; c < 3; ++c) same = same && ours.color(static_cast<int>(c))[i] == theirs[4 * i + c];
    count += same ? 0 : 1;
  }
  return count;
}

// The shortest of the rival's draws that fit into `seconds`; the clears are not timed, as ours are not.
Status measure_rival(bench::LlvmpipeMesh& rival, const bench::Mesh& mesh, const Surface& ours, double seconds,
                     RasterRow& row) {
  rival.prepare(mesh);
  double shortest = 1e9;
  const auto start = bench::Clock::now();
  for (int runs = 0; runs < 3 || bench::seconds_since(start) < seconds; ++runs) {
    rival.clear();
    shortest = std::min(shortest, bench::seconds_of([&] { rival.draw(); }));
  }
  const auto picture = rival.picture();
  if (!picture) return picture.error();
  row.rival_mtriangles_per_s = static_cast<double>(mesh.triangles.size()) / shortest / 1e6;
  row.pixels_that_differ = pixels_that_differ(ours, *picture);
  return {};
}

// Measures one workload, on one thread and on all, and then the rival's threads on all.
Status measure(const BenchFlags& flags, const Workload& workload, const Size& size, bench::LlvmpipeMesh* rival,
               std::vector<RasterRow>& rows) {
  const bool is_large = workload.leg == 0.0F;
  const bench::Mesh mesh =
      is_large ? bench::large_triangles() : bench::small_triangles(size.width, size.height, workload.leg);
  const auto covered = bench::covered_pixels(mesh, size.width, size.height);
  if (!covered) return covered.error();
  auto surface = Surface::make(size.width, size.height);
  if (!surface) return surface.error();
  for (const int threads : one_and_all_threads(flags.common)) {
    const ThreadLimit limit(threads);
    const auto seconds = bench::seconds_to_draw(mesh, *surface, flags.time_limit());
    if (!seconds) return seconds.error();
    RasterRow row{workload.name,
                  threads,
                  static_cast<double>(mesh.triangles.size()) / *seconds / 1e6,
                  static_cast<double>(*covered) / *seconds / 1e6,
                  mesh.triangles.size(),
                  *covered};
    if (is_large) {
      const std::size_t planes = 8 * static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
      row.memset_gb_per_s = bench::memset_rate(planes, threads, flags.time_limit());
    }
    if (rival != nullptr && threads == thread_count(flags.common)) {
      if (Status done = measure_rival(*rival, mesh, *surface, flags.time_limit(), row); !done) return done;
    }
    rows.push_back(std::move(row));
  }
  return {};
}

std::string table(const std::vector<RasterRow>& rows) {
  std::string text = fmt::format("{:<9} {:>7} {:>12} {:>10} {:>10} {:>12}\n", "workload", "threads", "Mtriangle/s",
                                 "Mpixel/s", "triangles", "pixels");
  for (const RasterRow& r : rows) {
    text += fmt::format("{:<9} {:>7} {:>12.3f} {:>10.1f} {:>10} {:>12}\n", r.workload, r.threads, r.mtriangles_per_s,
                        r.mpixels_per_s, r.triangles, r.covered_pixels);
  }
  for (const RasterRow& r : rows) {
    if (r.rival_mtriangles_per_s) {
      text += fmt::format("{}, threads {}: llvmpipe {:.3f} Mtriangle/s, {:.1f} times slower; {} pixels differ\n",
                          r.workload, r.threads, *r.rival_mtriangles_per_s,
                          r.mtriangles_per_s / *r.rival_mtriangles_per_s, r.pixels_that_differ);
    }
    if (r.memset_gb_per_s) {
      text += fmt::format("{}, threads {}: {:.1f} GB/s of colour and depth, {:.0f} % of memset's {:.1f} GB/s\n",
                          r.workload, r.threads, r.written_gb_per_s(),
                          100.0 * r.written_gb_per_s() / *r.memset_gb_per_s, *r.memset_gb_per_s);
    }
  }
  return text;
}

Json json_of(const RasterRow& r) {
  Json row{{"workload", r.workload},
           {"threads", r.threads},
           {"mtriangles_per_s", r.mtriangles_per_s},
           {"mpixels_per_s", r.mpixels_per_s},
           {"covered_pixels", r.covered_pixels},
           {"triangles", r.triangles}};
  if (r.rival_mtriangles_per_s) {
    row["rival"] = {{"mtriangles_per_s", *r.rival_mtriangles_per_s},
                    {"ratio", r.mtriangles_per_s / *r.rival_mtriangles_per_s},
                    {"pixels_that_differ", r.pixels_that_differ}};
  }
  if (r.memset_gb_per_s) {
    row["written_gb_per_s"] = r.written_gb_per_s();
    row["memset_gb_per_s"] = *r.memset_gb_per_s;
  }
  return row;
}

int bench_raster(const RasterFlags& raster) {
  const BenchFlags& flags = raster.bench;
  const OnGivenTarget on(flags);
  const Size size = flags.quick ? Size{128, 96} : Size{1024, 768};
  const std::vector<Workload> workloads{{"legs-1", 1.0F}, {"legs-4", 4.0F}, {"legs-16", 16.0F}, {"large", 0.0F}};
  std::unique_ptr<bench::LlvmpipeMesh> rival;
  if (!raster.rival.empty()) {
    auto made = bench::LlvmpipeMesh::make(size.width, size.height, thread_count(flags.common));
    if (!made) {
      say_error(fmt::format("--rival {} is not available: {}", raster.rival, made.error().text()));
      return kWrongUsage;
    }
    rival = std::move(*made);
  }
  std::optional<ProgressLine> line(std::in_place, flags.common.quiet);
  std::vector<RasterRow> rows;
  for (std::size_t i = 0; i < workloads.size(); ++i) {
    if (!line->step(workloads[i].name, static_cast<double>(i) / static_cast<double>(workloads.size()))) {
      return line.reset(), report({.message = "interrupted", .fault = Fault::cancelled});
    }
    if (Status measured = measure(flags, workloads[i], size, rival.get(), rows); !measured) {
      return line.reset(), report(measured.error());
    }
  }
  line.reset();
  if (!flags.common.json) return answer(table(rows));
  Json list = Json::array();
  for (const RasterRow& r : rows) list.push_back(json_of(r));
  Json out{{"command", "bench raster"},
           {"version", NINEBIT_VERSION},
           {"profile", flags.common.profile},
           {"size", {size.width, size.height}},
           {"rows", std::move(list)}};
  if (rival) out["rival"] = {{"name", raster.rival}, {"renderer", rival->renderer()}};
  return answer(out);
}

struct GrowthRow {
  std::string workload;
  const char* call;
  int threads = 1;
  std::size_t triangles = 0;
  std::uint64_t covered_pixels = 0;
  double ms = 0.0, ns_per_triangle = 0.0, bytes_per_triangle = 0.0;
};

// The size of a window for about so many triangles: three layers of cells, two triangles per cell.
Size window_of(double triangles, float leg) {
  const auto side = [&](double aspect) {
    return static_cast<int>(leg * static_cast<float>(std::sqrt(triangles / 6.0 * aspect) + 1.0));
  };
  return {side(4.0 / 3.0), side(3.0 / 4.0)};
}

// Measures one workload with about so many triangles. Memory is the peak of the process minus the mesh, the surface and
// the `idle` bytes that it held before the first workload.
Status measure_growth(const BenchFlags& flags, const Workload& workload, double triangles, std::uint64_t idle,
                      std::vector<GrowthRow>& rows) {
  const Size size = window_of(triangles, workload.leg);
  const bench::Mesh mesh = bench::small_triangles(size.width, size.height, workload.leg);
  const auto covered = bench::covered_pixels(mesh, size.width, size.height);
  if (!covered) return covered.error();
  auto surface = Surface::make(size.width, size.height);
  if (!surface) return surface.error();
  const std::uint64_t given =
      mesh.positions.size() * sizeof(mesh.positions[0]) + mesh.triangles.size() * sizeof(mesh.triangles[0]) +
      mesh.colors.size() * sizeof(mesh.colors[0]) + surface->stencil().size() * (4 + sizeof(std::uint32_t) + 1);
  const auto count = static_cast<double>(mesh.triangles.size());
  const auto add = [&](const char* call, auto seconds_of_call) -> Status {
    bench::forget_peak();
    const auto seconds = seconds_of_call(mesh, *surface, flags.time_limit());
    if (!seconds) return seconds.error();
    const std::uint64_t peak = bench::peak_resident_bytes();
    rows.push_back({workload.name, call, thread_count(flags.common), mesh.triangles.size(), *covered, *seconds * 1e3,
                    *seconds * 1e9 / count, static_cast<double>(peak - std::min(peak, idle + given)) / count});
    return {};
  };
  if (Status measured = add("rasterize", bench::seconds_to_draw); !measured) return measured;
  return add("prepare", bench::seconds_to_prepare_and_draw);
}

std::string table(const std::vector<GrowthRow>& rows) {
  std::string text = fmt::format("{:<9} {:<9} {:>7} {:>10} {:>10} {:>10} {:>12} {:>15}\n", "workload", "call",
                                 "threads", "triangles", "pixels", "ms", "ns/triangle", "bytes/triangle");
  for (const GrowthRow& r : rows) {
    text += fmt::format("{:<9} {:<9} {:>7} {:>10} {:>10} {:>10.3f} {:>12.1f} {:>15.0f}\n", r.workload, r.call,
                        r.threads, r.triangles, r.covered_pixels, r.ms, r.ns_per_triangle, r.bytes_per_triangle);
  }
  return text;
}

// Workloads grow, so that memory that one leaves in the threads is small beside that of the next.
int bench_growth(const BenchFlags& flags) {
  const std::vector<double> counts = flags.quick ? std::vector{1e3, 1e4} : std::vector{1e3, 1e4, 1e5, 1e6, 1e7};
  const ThreadLimit limit(thread_count(flags.common));
  const OnGivenTarget on(flags);
  const std::uint64_t idle = bench::resident_bytes();
  std::optional<ProgressLine> line(std::in_place, flags.common.quiet);
  std::vector<GrowthRow> rows;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    for (const Workload& workload : {Workload{"legs-1", 1.0F}, Workload{"legs-4", 4.0F}}) {
      const double done = static_cast<double>(i) / static_cast<double>(counts.size());
      Status measured = Diagnostic{.message = "interrupted", .fault = Fault::cancelled};
      if (line->step(workload.name, done)) measured = measure_growth(flags, workload, counts[i], idle, rows);
      if (!measured) return line.reset(), report(measured.error());
    }
  }
  line.reset();
  if (!flags.common.json) return answer(table(rows));
  Json list = Json::array();
  for (const GrowthRow& r : rows) {
    list.push_back({{"workload", r.workload},
                    {"call", r.call},
                    {"threads", r.threads},
                    {"triangles", r.triangles},
                    {"covered_pixels", r.covered_pixels},
                    {"ms", r.ms},
                    {"ns_per_triangle", r.ns_per_triangle},
                    {"bytes_per_triangle", r.bytes_per_triangle}});
  }
  const Json out{{"command", "bench raster --growth"},
                 {"version", NINEBIT_VERSION},
                 {"profile", flags.common.profile},
                 {"rows", std::move(list)}};
  return answer(out);
}

}  // namespace

void add_bench_raster(CLI::App& bench, int& exit_code) {
  CLI::App* verb =
      bench.add_subcommand("raster", "Measure triangles and pixels per second, with depth test and flat colour");
  verb->footer(
      "Example: ninebit bench raster --threads 2 --json\n"
      "Memory per triangle is the peak of the process minus its start, the triangles and the surface.");
  auto flags = std::make_shared<RasterFlags>();
  add_bench_flags(*verb, flags->bench);
  CLI::Option* growth = verb->add_flag(
      "--growth", flags->growth, "Measure time and memory per triangle, from a thousand to ten million triangles");
  verb->add_option("--rival", flags->rival, "Draw the same meshes with this renderer too, on all threads: llvmpipe")
      ->check(CLI::IsMember({"llvmpipe"}))
      ->excludes(growth);
  add_target_flag(*verb, flags->bench);
  verb->callback([=, &exit_code] { exit_code = flags->growth ? bench_growth(flags->bench) : bench_raster(*flags); });
}

}  // namespace ninebit::tools
