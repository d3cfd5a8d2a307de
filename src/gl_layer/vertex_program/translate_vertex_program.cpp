// NV_vertex_program printed for ARB_vertex_program. The instructions are the same but for RCC; what differs is around
// them:
//
// - Temporaries begin as 0, and results as (0, 0, 0, 1); ARB leaves both undefined. So a temporary that is read before
// it
//   is written is set, and so are the results that are written, and those that a fixed function may read without.
// - c[A0.x + n] outside of 0 to 95 is 0; ARB leaves it undefined. The array has a 0 before and one behind the
//   parameters, and the address is kept as a float that is clamped to these for each n.
// - A parameter that tracks a matrix is that matrix's row, so that a display list sees matrices as they change.
#include "src/gl_layer/vertex_program/vertex_program.h"

namespace ninebit::gl_layer {
namespace {

constexpr std::string_view kComponents = "xyzw";

std::string matrix_name(const TrackedMatrix& of) {
  const std::string number = "[" + std::to_string(of.number) + "]";
  switch (of.source) {
    case MatrixSource::modelview:
      return "modelview[0]";
    case MatrixSource::projection:
      return "projection";
    case MatrixSource::texture:
      return "texture" + number;
    case MatrixSource::program:
      return "program" + number;
    default:
      return "mvp";
  }
}

std::string parameter_value(int index, const TrackedMatrices& matrices) {
  constexpr std::string_view kTransforms[]{"", ".inverse", ".transpose", ".invtrans"};
  const TrackedMatrix& tracked = matrices[static_cast<std::size_t>(index) / 4];
  if (tracked.source == MatrixSource::none) return "program.env[" + std::to_string(index) + "]";
  const std::string_view transform = kTransforms[static_cast<std::size_t>(tracked.transform)];
  return "state.matrix." + matrix_name(tracked) + std::string(transform) + ".row[" + std::to_string(index % 4) + "]";
}

std::string attribute_name(int index, unsigned arrays) {
  const bool generic = ((arrays | kGenericAttributes) >> static_cast<unsigned>(index) & 1) != 0;
  if (generic) return "vertex.attrib[" + std::to_string(index) + "]";
  switch (index) {
    case 0:
      return "vertex.position";
    case 2:
      return "vertex.normal";
    case 3:
      return "vertex.color";
    case 4:
      return "vertex.color.secondary";
    case 5:
      return "vertex.fogcoord";
    default:
      return "vertex.texcoord[" + std::to_string(index - 8) + "]";
  }
}

std::string output_name(int index) {
  constexpr std::string_view kNames[]{"position",           "color.front.primary",  "color.front.secondary",
                                      "color.back.primary", "color.back.secondary", "fogcoord",
                                      "pointsize"};
  constexpr int kTexture0 = static_cast<int>(VertexOutput::tex0);
  if (index >= kTexture0) return "result.texcoord[" + std::to_string(index - kTexture0) + "]";
  return "result." + std::string(kNames[index]);
}

// The results that fixed functions and fragment shaders may read of every vertex: colours, fog, and the coordinates of
// the four textures that these chips had.
constexpr unsigned kResultsThatAreRead = 0b111'1011'1110;

class Translation {
 public:
  Translation(const VertexProgram& program, const TrackedMatrices& matrices, unsigned arrays)
      : program_(program), matrices_(matrices), arrays_(arrays) {}

  std::string text() {
    for (const VertexInstruction& one : program_.instructions) add(one);
    std::string out = "!!ARBvp1.0\n";
    if (program_.position_invariant) out += "OPTION ARB_position_invariant;\n";
    return out + declarations() + initial_values() + code_ + "END\n";
  }

 private:
  std::string declarations() const {
    std::string out = "TEMP R0, R1, R2, R3, R4, R5, R6, R7, R8, R9, R10, R11;\n";
    if (uses_scratch_) out += "TEMP scratch;\n";
    if (uses_limits_) {
      out += "PARAM limits = { 5.421010862427522e-20, 18446744073709551616.0, -2.0, 0.0 };\n";  // 2^-64 and 2^64
    }
    if (program_.reads_relative) {
      out += "TEMP address;\nADDRESS A0;\nPARAM all[98] = { { 0.0, 0.0, 0.0, 0.0 }";
      for (int i = 0; i < kVertexParameters; ++i) out += ", " + parameter_value(i, matrices_);
      out += ", { 0.0, 0.0, 0.0, 0.0 } };\n";
    }
    for (int i = 0; i < kVertexParameters; ++i) {
      if (!program_.parameters[static_cast<std::size_t>(i)] || program_.reads_relative) continue;
      out += "PARAM c" + std::to_string(i) + " = " + parameter_value(i, matrices_) + ";\n";
    }
    for (int i = 0; i < kVertexAttributes; ++i) {
      if ((program_.attributes >> static_cast<unsigned>(i) & 1) == 0) continue;
      out += "ATTRIB v" + std::to_string(i) + " = " + attribute_name(i, arrays_) + ";\n";
    }
    return out;
  }

  std::string initial_values() const {
    const unsigned results = (program_.outputs | kResultsThatAreRead) & ~fully_written_;
    std::string out = "PARAM initial = { 0.0, 0.0, 0.0, 1.0 };\n";
    for (int i = 0; i < kVertexOutputs; ++i) {
      if ((results >> static_cast<unsigned>(i) & 1) != 0) out += "MOV " + output_name(i) + ", initial;\n";
    }
    for (std::size_t i = 0; i < kVertexTemporaries; ++i) {
      if (read_early_[i]) out += "MOV R" + std::to_string(i) + ", initial.x;\n";
    }
    if (program_.reads_relative) out += "MOV address, initial.x;\n";
    return out;
  }

  void add(const VertexInstruction& instruction) {
    const VertexOpcodeInfo& info = info_of(instruction.opcode);
    std::array<std::string, 3> operands;
    for (std::size_t i = 0; i < static_cast<std::size_t>(info.operands); ++i) {
      operands[i] = operand(instruction.operands[i], info.scalar);
    }
    if (instruction.opcode == VertexOpcode::arl) {
      if (program_.reads_relative) code_ += "FLR address.x, " + operands[0] + ";\n";
      return;
    }
    const std::string destination = target(instruction);
    if (instruction.opcode == VertexOpcode::rcc) {
      add_clamped_reciprocal(destination, operands[0]);
    } else {
      code_ += std::string(info.name) + ' ' + destination;
      for (std::size_t i = 0; i < static_cast<std::size_t>(info.operands); ++i) code_ += ", " + operands[i];
      code_ += ";\n";
    }
  }

  // 1/x with a magnitude of 2^-64 to 2^64 and the sign of x; that of -0 shows in the reciprocal alone, that of
  // -infinity in x alone.
  void add_clamped_reciprocal(const std::string& destination, const std::string& x) {
    uses_scratch_ = uses_limits_ = true;
    code_ += "MOV scratch.w, " + x +
             ";\n"
             "RCP scratch.x, scratch.w;\n"
             "SLT scratch.z, scratch.x, limits.w;\n"
             "SLT scratch.w, scratch.w, limits.w;\n"
             "MAX scratch.z, scratch.z, scratch.w;\n"
             "ABS scratch.x, scratch.x;\n"
             "MAX scratch.x, scratch.x, limits.x;\n"
             "MIN scratch.x, scratch.x, limits.y;\n"
             "MUL scratch.y, scratch.x, scratch.z;\n"
             "MAD " +
             destination + ", scratch.y, limits.z, scratch.x;\n";
  }

  std::string target(const VertexInstruction& instruction) {
    const auto index = static_cast<std::size_t>(instruction.index);
    std::string out;
    if (instruction.file == VertexFile::output) {
      out = output_name(instruction.index);
      if (instruction.mask == 15) fully_written_ |= 1U << index;
    } else {
      out = "R" + std::to_string(instruction.index);
      written_[index] |= instruction.mask;
    }
    if (instruction.mask == 15) return out;
    out += '.';
    for (std::size_t i = 0; i < 4; ++i) {
      if ((instruction.mask >> i & 1) != 0) out += kComponents[i];
    }
    return out;
  }

  std::string operand(const VertexOperand& of, bool scalar) {
    const std::string number = std::to_string(of.index);
    std::string out = of.negated ? "-" : "";
    switch (of.file) {
      case VertexFile::attribute:
        out += "v" + number;
        break;
      case VertexFile::parameter:
        out += program_.reads_relative ? "all[" + std::to_string(of.index + 1) + "]" : "c" + number;
        break;
      case VertexFile::relative_parameter:
        out += relative(of.index);
        break;
      default:
        out += "R" + number;
        for (const std::size_t component : of.swizzle) {
          const bool known = (written_[static_cast<std::size_t>(of.index)] >> component & 1) != 0;
          if (!known) read_early_[static_cast<std::size_t>(of.index)] = true;
        }
    }
    if (scalar) return out + '.' + kComponents[of.swizzle[0]];
    if (of.swizzle == VertexOperand{}.swizzle) return out;
    out += '.';
    for (const std::size_t component : of.swizzle) out += kComponents[component];
    return out;
  }

  // c[A0.x + n]: the code before the instruction loads A0 so that it stays in the array.
  std::string relative(int n) {
    uses_scratch_ = true;
    const std::string low = std::to_string(-1 - n) + ".0", high = std::to_string(kVertexParameters - n) + ".0";
    code_ += "MAX scratch.x, address.x, " + low + ";\nMIN scratch.x, scratch.x, " + high + ";\n";
    // The array's offsets end at 63 and -64; its own begins one further.
    code_ += "ADD scratch.x, scratch.x, 1.0;\nARL A0.x, scratch.x;\n";
    if (n == 0) return "all[A0.x]";
    return n > 0 ? "all[A0.x + " + std::to_string(n) + "]" : "all[A0.x - " + std::to_string(-n) + "]";
  }

  const VertexProgram& program_;
  const TrackedMatrices& matrices_;
  unsigned arrays_;
  std::string code_{};
  std::array<unsigned, kVertexTemporaries> written_{};  // components so far
  std::array<bool, kVertexTemporaries> read_early_{};
  unsigned fully_written_ = 0;
  bool uses_scratch_ = false, uses_limits_ = false;
};

}  // namespace

TrackedMatrices read_matrices(const VertexProgram& program, const TrackedMatrices& all) {
  if (program.reads_relative) return all;
  TrackedMatrices read;
  for (std::size_t i = 0; i < kVertexParameters; ++i) {
    if (program.parameters[i]) read[i / 4] = all[i / 4];
  }
  return read;
}

std::string translate_vertex_program(const VertexProgram& program, const TrackedMatrices& matrices, unsigned arrays) {
  return Translation(program, matrices, arrays).text();
}

}  // namespace ninebit::gl_layer
