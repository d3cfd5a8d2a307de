// Programs of NV_vertex_program as data: read from their text, printed for ARB_vertex_program, executed. No OpenGL
// here.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ninebit::gl_layer {

inline constexpr int kVertexParameters = 96, kVertexTemporaries = 12, kVertexAttributes = 16, kVertexInstructions = 128;

enum class VertexOpcode : std::uint8_t {
  arl,
  mov,
  mul,
  add,
  mad,
  rcp,
  rsq,
  dp3,
  dp4,
  dst,
  min,
  max,
  slt,
  sge,
  exp,
  log,
  lit,  // 1.0
  dph,
  rcc,
  sub,
  abs  // 1.1
};

// An opcode's name, its number of operands, and whether they are single components.
struct VertexOpcodeInfo {
  VertexOpcode opcode;
  std::string_view name;
  int operands;
  bool scalar;
  bool since_1_1;
};
[[nodiscard]] const VertexOpcodeInfo& info_of(VertexOpcode opcode);

enum class VertexFile : std::uint8_t { temporary, attribute, parameter, relative_parameter, output, address };

// In the order of their numbers.
enum class VertexOutput : std::uint8_t { hpos, col0, col1, bfc0, bfc1, fogc, psiz, tex0 };  // and so on to TEX7
inline constexpr int kVertexOutputs = 15;

struct VertexOperand {
  VertexFile file = VertexFile::temporary;
  int index = 0;  // of the register; of relative_parameter: what is added to A0.x
  bool negated = false;
  std::array<std::uint8_t, 4> swizzle{0, 1, 2, 3};  // of a scalar operand all four are equal
  bool operator==(const VertexOperand&) const = default;
};

struct VertexInstruction {
  VertexOpcode opcode = VertexOpcode::mov;
  VertexFile file = VertexFile::temporary;  // of the destination
  int index = 0;
  unsigned mask = 15;  // bit 0: x
  std::array<VertexOperand, 3> operands{};
  bool operator==(const VertexInstruction&) const = default;
};

enum class VertexProgramKind : std::uint8_t { vertex, state };

struct VertexProgram {
  VertexProgramKind kind = VertexProgramKind::vertex;
  bool position_invariant = false;
  std::vector<VertexInstruction> instructions{};

  unsigned attributes = 0;                           // that it reads, a bit each
  unsigned outputs = 0;                              // that it writes
  bool reads_relative = false;                       // c[A0.x + n], which may be any parameter
  std::array<bool, kVertexParameters> parameters{};  // that it reads by number
  bool operator==(const VertexProgram&) const = default;
};

// What is wrong with a text, and the byte at which it shows.
struct VertexFault {
  std::size_t position = 0;
  std::string message{};
};

// Reads "!!VP1.0", "!!VP1.1" or "!!VSP1.0". Text after END is ignored, as drivers of the time did. Empty: `fault` says
// why.
[[nodiscard]] std::optional<VertexProgram> parse_vertex_program(std::string_view text, VertexProgramKind kind,
                                                                bool allows_1_1, VertexFault& fault);

// A matrix whose rows stand in four parameters; `none`: the parameters are the program's own.
enum class MatrixSource : std::uint8_t { none, modelview, projection, modelview_projection, texture, program };
enum class MatrixTransform : std::uint8_t { identity, inverse, transpose, inverse_transpose };
struct TrackedMatrix {
  MatrixSource source = MatrixSource::none;
  std::uint8_t number = 0;  // of the texture unit or the program matrix
  MatrixTransform transform = MatrixTransform::identity;
  auto operator<=>(const TrackedMatrix&) const = default;
};
using TrackedMatrices = std::array<TrackedMatrix, kVertexParameters / 4>;

// Those of the matrices that a program can read.
[[nodiscard]] TrackedMatrices read_matrices(const VertexProgram& program, const TrackedMatrices& all);

// The program as "!!ARBvp1.0". Its parameters are program.env[0] to [95]. `arrays` has a bit for each attribute that is
// read as a generic one; the others are the conventional attributes of their numbers.
[[nodiscard]] std::string translate_vertex_program(const VertexProgram& program, const TrackedMatrices& matrices,
                                                   unsigned arrays);

// Attributes that have no conventional one.
inline constexpr unsigned kGenericAttributes = 1U << 1 | 1U << 6 | 1U << 7;

using VertexVector = std::array<float, 4>;

// Executes a state program: v[0] is given, c[] is read and written.
void execute_state_program(const VertexProgram& program, const VertexVector& attribute0,
                           std::array<VertexVector, kVertexParameters>& parameters);

}  // namespace ninebit::gl_layer
