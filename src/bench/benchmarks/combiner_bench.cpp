// Throughput of the batch evaluator and of the reference on the measured programs. Items are fragments.
#include <benchmark/benchmark.h>

#include <memory>

#include "ninebit/combiner/batch_program.h"
#include "ninebit/combiner/normalize.h"
#include "src/bench/programs.h"

namespace {

using namespace ninebit;

Program program_of(std::size_t number) {
  const auto programs = bench::measured_programs(profiles::geforce2);
  return normalize(programs->at(number).state, programs->at(number).profile);
}

void batch(benchmark::State& state, std::size_t number) {
  const BatchProgram program(program_of(number), {}, {}, BatchInputs::not_negative);
  const auto registers = std::make_unique<RegisterBatch>();
  const auto out = std::make_unique<OutputBatch>();
  s9 code = 0;
  for (auto& reg : registers->plane) {
    for (auto& component : reg) {
      for (s9& value : component) value = code = static_cast<s9>((code + 37) % 256);
    }
  }
  for ([[maybe_unused]] auto _ : state) {
    program.run(*registers, kBatchSize, *out);
    benchmark::DoNotOptimize(out->plane);
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()) * static_cast<std::int64_t>(kBatchSize));
}
BENCHMARK_CAPTURE(batch, index, 0);
BENCHMARK_CAPTURE(batch, heavy, 1);
BENCHMARK_CAPTURE(batch, eight, 2);
BENCHMARK_CAPTURE(batch, default_state, 3);

void reference_fragment(benchmark::State& state, std::size_t number) {
  const Program program = program_of(number);
  RegisterFile registers;
  registers[Register::primary] = {100, 50, 25, 255};
  registers[Register::texture0] = {102, 50, 25, 255};
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(evaluate(program, registers));
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()));
}
BENCHMARK_CAPTURE(reference_fragment, index, 0);
BENCHMARK_CAPTURE(reference_fragment, heavy, 1);
BENCHMARK_CAPTURE(reference_fragment, eight, 2);

}  // namespace
