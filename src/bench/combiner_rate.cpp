#include "src/bench/combiner_rate.h"

#include <algorithm>
#include <memory>
#include <numeric>
#include <random>

#include "hwy/highway.h"
#include "ninebit/combiner/batch_program.h"
#include "ninebit/combiner/evaluate.h"
#include "src/bench/scalar_float.h"
#include "src/bench/timing.h"

namespace ninebit::bench {
namespace {

// One thread's batch of fragments in both forms, with room for their colours.
struct Fragments {
  RegisterBatch planes;
  OutputBatch plane_colors;
  std::array<RegisterFile, kBatchSize> files;
  std::array<Rgba9, kBatchSize> colors;

  explicit Fragments(unsigned seed) {
    std::mt19937 random(seed);
    for (std::size_t r = 0; r < kRegisterCount; ++r) {
      for (std::size_t c = 0; c < 4; ++c) {
        for (std::size_t i = 0; i < kBatchSize; ++i) {
          files[i].value[r][c] = planes.plane[r][c][i] = static_cast<s9>(random() % 256);
        }
      }
    }
  }
};

// A program and the engine that evaluates it. Registers begin as bytes, as in the rasterizer.
struct Evaluator {
  const Program& program;
  Engine engine;
  BatchProgram batch{program, {}, {}, BatchInputs::not_negative};
};

// The timed work.
void evaluate_batch(const Evaluator& evaluator, Fragments& fragments) {
  const Program& program = evaluator.program;
  switch (evaluator.engine) {
    case Engine::simd:
      evaluator.batch.run(fragments.planes, kBatchSize, fragments.plane_colors);
      break;
    case Engine::reference:
      for (std::size_t i = 0; i < kBatchSize; ++i) fragments.colors[i] = evaluate(program, fragments.files[i]);
      break;
    case Engine::scalar_float:
      evaluate_scalar_float(program, fragments.files, fragments.colors.data());
      break;
  }
}

void evaluate_batches(const Evaluator& evaluator, Fragments& fragments, std::size_t batches) {
  for (std::size_t i = 0; i < batches; ++i) evaluate_batch(evaluator, fragments);
}

// The number of batches that takes about `seconds`.
std::size_t batches_in(double seconds, const Evaluator& evaluator, Fragments& fragments) {
  std::size_t batches = 1;
  while (seconds_of([&] { evaluate_batches(evaluator, fragments, batches); }) < seconds) batches *= 2;
  return batches;
}

}  // namespace

std::string_view name_of(Engine engine) {
  switch (engine) {
    case Engine::simd:
      return "simd";
    case Engine::reference:
      return "reference";
    case Engine::scalar_float:
      return "scalar-float";
  }
  return "";
}

double combiner_rate(const Program& program, Engine engine, int threads, double seconds) {
  const auto count = static_cast<std::size_t>(threads);
  std::vector<std::unique_ptr<Fragments>> fragments(count);
  for (std::size_t i = 0; i < count; ++i) fragments[i] = std::make_unique<Fragments>(static_cast<unsigned>(i));
  const Evaluator evaluator{program, engine};
  const std::size_t batches = batches_in(std::min(2e-3, seconds / 8), evaluator, *fragments[0]);
  const double shortest =
      shortest_together(threads, seconds, [&](std::size_t i) { evaluate_batches(evaluator, *fragments[i], batches); });
  return static_cast<double>(count * batches * kBatchSize) / shortest / 1e6;
}

double read_rate(std::size_t bytes, double seconds) {
  // Pieces are short enough for some to run undisturbed. A piece is repeated only after all others.
  constexpr std::size_t kPiece = (std::size_t{2} << 20U) / sizeof(std::uint64_t);
  const std::vector<std::uint64_t> memory(std::max(bytes / sizeof(std::uint64_t), kPiece), 1);
  double shortest = 1e9;
  std::uint64_t total = 0;
  const auto start = Clock::now();
  do {
    for (std::size_t first = 0; first + kPiece <= memory.size(); first += kPiece) {
      shortest = std::min(shortest, seconds_of([&] {
                            const std::uint64_t* const piece = memory.data() + first;
                            total += std::accumulate(piece, piece + kPiece, std::uint64_t{0});
                          }));
    }
  } while (seconds_since(start) < seconds);
  // The total is used so that the compiler cannot remove the sum.
  return total == 0 ? 0.0 : static_cast<double>(kPiece * sizeof(std::uint64_t)) / shortest / 1e9;
}

std::vector<std::string> simd_target_names() {
  std::vector<std::string> names;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) names.emplace_back(hwy::TargetName(target));
  return names;
}

OnSimdTarget::OnSimdTarget(const std::string& name) {
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    if (name == hwy::TargetName(target)) hwy::SetSupportedTargetsForTest(target);
  }
  hwy::GetChosenTarget().DeInit();
}

OnSimdTarget::~OnSimdTarget() {
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().DeInit();
}

}  // namespace ninebit::bench
