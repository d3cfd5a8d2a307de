// Throughput of the batch evaluator and of the reference on the article's program; items are fragments.
#include <benchmark/benchmark.h>

#include <memory>

#include "ninebit/combiner/evaluate.h"
#include "ninebit/shadow/index_cube.h"

namespace {

using namespace ninebit;

Program index_program() {
  return normalize(*index_comparison_state(profiles::geforce2), profiles::geforce2);
}

void index_batch(benchmark::State& state) {
  const Program program = index_program();
  const auto registers = std::make_unique<RegisterBatch>();
  const auto out = std::make_unique<OutputBatch>();
  s9 code = 0;
  for (auto& reg : registers->plane) {
    for (auto& component : reg) {
      for (s9& value : component) value = code = static_cast<s9>((code + 37) % 256);
    }
  }
  for (auto _ : state) {
    evaluate(program, *registers, kBatchSize, *out);
    benchmark::DoNotOptimize(out->plane);
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()) * static_cast<std::int64_t>(kBatchSize));
}
BENCHMARK(index_batch);

void index_reference(benchmark::State& state) {
  const Program program = index_program();
  RegisterFile registers;
  registers[Register::primary] = {100, 50, 25, 255};
  registers[Register::texture0] = {102, 50, 25, 255};
  for (auto _ : state) benchmark::DoNotOptimize(evaluate(program, registers));
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()));
}
BENCHMARK(index_reference);

}  // namespace
