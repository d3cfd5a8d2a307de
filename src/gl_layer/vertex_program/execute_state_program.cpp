// What each instruction computes, for programs that glExecuteProgramNV runs once.
#include <algorithm>
#include <cmath>
#include <limits>

#include "src/gl_layer/vertex_program/vertex_program.h"

namespace ninebit::gl_layer {
namespace {

using Operands = std::array<VertexVector, 3>;

VertexVector all_of(float value) {
  return {value, value, value, value};
}

template <class Function>
VertexVector each(const VertexVector& a, const VertexVector& b, const Function& function) {
  return {function(a[0], b[0]), function(a[1], b[1]), function(a[2], b[2]), function(a[3], b[3])};
}

float dot3(const VertexVector& a, const VertexVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

float clamped_reciprocal(float x) {
  const float reciprocal = 1.0F / x;
  return std::copysign(std::clamp(std::fabs(reciprocal), 0x1p-64F, 0x1p64F), reciprocal);
}

VertexVector exponential(float x) {
  const float whole = std::floor(x);
  return {std::exp2(whole), x - whole, std::exp2(x), 1};
}

VertexVector logarithm(float x) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const float magnitude = std::fabs(x);
  if (magnitude == 0.0F) return {-kInfinity, 1, -kInfinity, 1};
  if (std::isinf(magnitude)) return {kInfinity, 1, kInfinity, 1};
  int exponent = 0;
  const float fraction = std::frexp(magnitude, &exponent);  // 0.5 to 1
  return {static_cast<float>(exponent - 1), 2 * fraction, std::log2(magnitude), 1};
}

VertexVector lit(const VertexVector& a) {
  const float diffuse = std::max(a[0], 0.0F), specular = std::max(a[1], 0.0F);
  const float power = std::clamp(a[3], -127.9961F, 127.9961F);
  return {1, diffuse, a[0] > 0.0F ? std::pow(specular, power) : 0.0F, 1};
}

VertexVector compute(VertexOpcode opcode, const Operands& of) {
  const auto& [a, b, c] = of;
  switch (opcode) {
    case VertexOpcode::arl:
    case VertexOpcode::mov:
      return a;
    case VertexOpcode::mul:
      return each(a, b, [](float x, float y) { return x * y; });
    case VertexOpcode::add:
      return each(a, b, [](float x, float y) { return x + y; });
    case VertexOpcode::mad:
      return each(compute(VertexOpcode::mul, of), c, [](float x, float y) { return x + y; });
    case VertexOpcode::rcp:
      return all_of(1.0F / a[0]);
    case VertexOpcode::rsq:
      return all_of(1.0F / std::sqrt(std::fabs(a[0])));
    case VertexOpcode::dp3:
      return all_of(dot3(a, b));
    case VertexOpcode::dp4:
      return all_of(dot3(a, b) + a[3] * b[3]);
    case VertexOpcode::dst:
      return {1, a[1] * b[1], a[2], b[3]};
    case VertexOpcode::min:
      return each(a, b, [](float x, float y) { return x < y ? x : y; });
    case VertexOpcode::max:
      return each(a, b, [](float x, float y) { return x >= y ? x : y; });
    case VertexOpcode::slt:
      return each(a, b, [](float x, float y) { return x < y ? 1.0F : 0.0F; });
    case VertexOpcode::sge:
      return each(a, b, [](float x, float y) { return x >= y ? 1.0F : 0.0F; });
    case VertexOpcode::exp:
      return exponential(a[0]);
    case VertexOpcode::log:
      return logarithm(a[0]);
    case VertexOpcode::lit:
      return lit(a);
    case VertexOpcode::dph:
      return all_of(dot3(a, b) + b[3]);
    case VertexOpcode::rcc:
      return all_of(clamped_reciprocal(a[0]));
    case VertexOpcode::sub:
      return each(a, b, [](float x, float y) { return x - y; });
    case VertexOpcode::abs:
      return each(a, a, [](float x, float) { return std::fabs(x); });
  }
  return a;
}

}  // namespace

void execute_state_program(const VertexProgram& program, const VertexVector& attribute0,
                           std::array<VertexVector, kVertexParameters>& parameters) {
  std::array<VertexVector, kVertexTemporaries> temporaries{};
  double address = 0;
  const auto read = [&](const VertexOperand& operand) {
    VertexVector value{};
    if (operand.file == VertexFile::temporary) value = temporaries[static_cast<std::size_t>(operand.index)];
    if (operand.file == VertexFile::attribute) value = attribute0;
    if (operand.file == VertexFile::parameter) value = parameters[static_cast<std::size_t>(operand.index)];
    if (operand.file == VertexFile::relative_parameter) {
      const double index = address + operand.index;
      if (index >= 0 && index < kVertexParameters) value = parameters[static_cast<std::size_t>(index)];
    }
    VertexVector out{};
    for (std::size_t i = 0; i < 4; ++i)
      out[i] = operand.negated ? -value[operand.swizzle[i]] : value[operand.swizzle[i]];
    return out;
  };
  for (const VertexInstruction& one : program.instructions) {
    const Operands operands{read(one.operands[0]), read(one.operands[1]), read(one.operands[2])};
    const VertexVector result = compute(one.opcode, operands);
    if (one.file == VertexFile::address) {
      address = std::floor(static_cast<double>(result[0]));
      continue;
    }
    VertexVector& target = one.file == VertexFile::parameter ? parameters[static_cast<std::size_t>(one.index)]
                                                             : temporaries[static_cast<std::size_t>(one.index)];
    for (std::size_t i = 0; i < 4; ++i) {
      if ((one.mask >> i & 1) != 0) target[i] = result[i];
    }
  }
}

}  // namespace ninebit::gl_layer
