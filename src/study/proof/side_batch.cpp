#include "src/study/proof/side_batch.h"

#include <algorithm>

#include "src/combiner/given_registers.h"

namespace ninebit::proof {
namespace {

constexpr std::array kConstants{Register::constant0, Register::constant1};

}  // namespace

SideBatch::SideBatch(const Subject& side, const std::optional<Program>& program, const BatchOutputs& outputs)
    : side_(side),
      program_(program),
      outputs_(outputs),
      registers_(std::make_unique<RegisterBatch>()),
      constants_(static_cast<std::size_t>(std::count_if(side.components.begin(), side.components.end(), is_constant))) {
  if (!program_ || side.runs_in_rows()) return;
  varying_ = *varying_constants(side.program);
  ComponentSet varying;
  for (std::size_t which = 0; which < 2; ++which) {
    for (int c = 0; varying_[which] && c < 4; ++c) varying.add(kConstants[which], c);
  }
  batch_.emplace(*program_, outputs_, varying);
}

s9* SideBatch::plane(int index) {
  if (!is_constant(index)) return (*registers_)(register_at(index), index % 4);
  const auto first = std::find_if(side_.components.begin(), side_.components.end(), is_constant);
  const auto at = std::find(first, side_.components.end(), index);
  return constants_[static_cast<std::size_t>(at - first)].data();
}

void SideBatch::run(std::size_t count, OutputBatch& out) {
  if (!program_) return;
  if (!batch_) return run_in_rows(count, out);
  for (std::size_t which = 0; which < 2; ++which) {
    for (int c = 0; varying_[which] && c < 4; ++c) {
      std::copy_n(plane(index_of(*varying_[which], c)), count, (*registers_)(kConstants[which], c));
    }
  }
  batch_->run(*registers_, count, out);
}

void SideBatch::run_in_rows(std::size_t count, OutputBatch& out) {
  for (std::size_t k = 0; k < count; ++k) {
    RegisterFile file;
    for (const int i : side_.components) {
      const s9 code = plane(i)[k];
      if (is_constant(i)) {
        replace_unset_constant(*program_, *input_at(i, 0).constant, i % 4, code);
      } else {
        file[register_at(i)][static_cast<std::size_t>(i % 4)] = code;
      }
    }
    const EvaluatedFragment result = evaluate_fragment(*program_, file);
    for (std::size_t c = 0; c < 4; ++c) out.plane[c][k] = result.color[c];
    for (const int i : side_.components) {
      if (!outputs_.registers || is_constant(i)) continue;
      plane(i)[k] = result.registers[register_at(i)][static_cast<std::size_t>(i % 4)];
    }
  }
}

}  // namespace ninebit::proof
