// The driver's programs of a context: one for each normalized program without its constants and each kind of inputs.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "ninebit/combiner/normalize.h"
#include "ninebit/combiner/program.h"
#include "ninebit/language/glsl.h"
#include "src/gl_layer/shader/own_programs.h"
#include "src/gl_layer/shader/shader_inputs.h"

namespace ninebit::gl_layer {

// The codes of all constants, as the uniform array of a shader holds them.
using ConstantCodes = std::array<std::array<int, 4>, kGlslConstants>;

// The numbers of texture-shader stages that are uniforms, likewise.
struct StageUniforms {
  std::array<float, 4 * kLayerUnits> matrices{};
  std::array<float, 2 * kLayerUnits> scales{};  // and biases
  std::array<float, 3 * kLayerUnits> eyes{};
  bool operator==(const StageUniforms&) const = default;
};

struct CachedProgram {
  Program program{};  // its constants are 0
  ShaderInputs inputs{};
  unsigned driver_program = 0;                   // 0: the driver refused the shader
  int constants = -1;                            // the uniform array's location; -1: the shader reads none
  std::array<int, 3> stage_numbers{-1, -1, -1};  // locations of the stages' matrices, scales with biases, eyes
  std::size_t number = 0;                        // in the order of first use in the process, from 1
  std::string shader{};                          // its text
  std::shared_ptr<std::atomic<std::uint64_t>> draws = std::make_shared<std::atomic<std::uint64_t>>(0);  // calls with it
  ConstantCodes uploaded{};  // what the uniform array holds
  std::optional<StageUniforms> uploaded_stages{};
  bool dumped = false;  // whether --dump has written it
};

class ProgramCache {
 public:
  explicit ProgramCache(OwnPrograms& own) : own_(own) {}
  ~ProgramCache();
  ProgramCache(const ProgramCache&) = delete;
  ProgramCache& operator=(const ProgramCache&) = delete;
  // The program for a state, compiled if it is new. Makes a program of the driver current when it compiles.
  CachedProgram& find(const Program& program, const HardwareProfile& profile, const ShaderInputs& inputs);
  [[nodiscard]] std::size_t size() const { return size_; }

 private:
  OwnPrograms& own_;  // of the context's group, which outlives it
  std::size_t size_ = 0;
  std::unordered_map<std::uint64_t, std::vector<std::unique_ptr<CachedProgram>>> programs_{};  // by hash
};

// The program without its constants, which go into a shader's uniform array.
[[nodiscard]] Program without_constants(Program program);
[[nodiscard]] ConstantCodes constant_codes(const Program& program);

// Numbers that differ for most different programs.
[[nodiscard]] std::uint64_t hash_of(const Program& program, const ShaderInputs& inputs);

}  // namespace ninebit::gl_layer
