// The grammar of NV_vertex_program and NV_vertex_program1_1.
#include <algorithm>
#include <iterator>

#include "src/gl_layer/vertex_program/vertex_program.h"
#include "src/system/characters.h"

namespace ninebit::gl_layer {
namespace {

constexpr VertexOpcodeInfo kOpcodes[]{
    {VertexOpcode::arl, "ARL", 1, true, false},  {VertexOpcode::mov, "MOV", 1, false, false},
    {VertexOpcode::mul, "MUL", 2, false, false}, {VertexOpcode::add, "ADD", 2, false, false},
    {VertexOpcode::mad, "MAD", 3, false, false}, {VertexOpcode::rcp, "RCP", 1, true, false},
    {VertexOpcode::rsq, "RSQ", 1, true, false},  {VertexOpcode::dp3, "DP3", 2, false, false},
    {VertexOpcode::dp4, "DP4", 2, false, false}, {VertexOpcode::dst, "DST", 2, false, false},
    {VertexOpcode::min, "MIN", 2, false, false}, {VertexOpcode::max, "MAX", 2, false, false},
    {VertexOpcode::slt, "SLT", 2, false, false}, {VertexOpcode::sge, "SGE", 2, false, false},
    {VertexOpcode::exp, "EXP", 1, true, false},  {VertexOpcode::log, "LOG", 1, true, false},
    {VertexOpcode::lit, "LIT", 1, false, false}, {VertexOpcode::dph, "DPH", 2, false, true},
    {VertexOpcode::rcc, "RCC", 1, true, true},   {VertexOpcode::sub, "SUB", 2, false, true},
    {VertexOpcode::abs, "ABS", 1, false, true}};

constexpr std::string_view kAttributeNames[]{"OPOS", "WGHT", "NRML", "COL0", "COL1", "FOGC", "",     "",
                                             "TEX0", "TEX1", "TEX2", "TEX3", "TEX4", "TEX5", "TEX6", "TEX7"};
constexpr std::string_view kOutputNames[kVertexOutputs]{"HPOS", "COL0", "COL1", "BFC0", "BFC1", "FOGC", "PSIZ", "TEX0",
                                                        "TEX1", "TEX2", "TEX3", "TEX4", "TEX5", "TEX6", "TEX7"};

struct Token {
  std::string_view text{};  // empty at the end of the text
  std::size_t position = 0;
};

// Words and single characters; '#' begins a comment to the end of its line.
class Tokens {
 public:
  Tokens(std::string_view text, std::size_t begin) : text_(text), at_(begin) { advance(); }
  [[nodiscard]] std::size_t size() const { return text_.size(); }
  [[nodiscard]] const Token& next() const { return next_; }
  Token take() {
    const Token taken = next_;
    advance();
    return taken;
  }
  bool accept(std::string_view word) {
    if (next_.text != word) return false;
    advance();
    return true;
  }

 private:
  void advance() {
    while (at_ < text_.size() && (detail::is_blank(text_[at_]) || text_[at_] == '#')) {
      if (text_[at_] == '#') {
        at_ = std::min(text_.find_first_of("\r\n", at_), text_.size());
      } else {
        ++at_;
      }
    }
    std::size_t end = at_;
    while (end < text_.size() && detail::is_word(text_[end])) ++end;
    if (end == at_ && at_ < text_.size()) ++end;
    next_ = {.text = text_.substr(at_, end - at_), .position = at_};
    at_ = end;
  }

  std::string_view text_;
  std::size_t at_;
  Token next_{};
};

class Parser {
 public:
  Parser(std::string_view text, std::size_t begin, VertexProgramKind kind, bool is_1_1, VertexFault& fault)
      : tokens_(text, begin), is_1_1_(is_1_1), fault_(fault) {
    program_.kind = kind;
  }

  std::optional<VertexProgram> parse() {
    if (!parse_options()) return std::nullopt;
    while (tokens_.next().text != "END") {
      VertexInstruction instruction;
      if (!parse_instruction(instruction)) return std::nullopt;
      program_.instructions.push_back(instruction);
    }
    if (!check_results()) return std::nullopt;
    return program_;
  }

 private:
  bool fail(const Token& at, const std::string& message) {
    fault_ = {.position = at.position, .message = message};
    return false;
  }

  bool expect(std::string_view word) {
    if (tokens_.accept(word)) return true;
    return fail(tokens_.next(), "expected '" + std::string(word) + "'");
  }

  bool parse_options() {
    while (is_1_1_ && tokens_.accept("OPTION")) {
      const Token option = tokens_.take();
      if (option.text != "NV_position_invariant") return fail(option, "expected NV_position_invariant");
      program_.position_invariant = true;
      if (!expect(";")) return false;
    }
    return true;
  }

  bool parse_instruction(VertexInstruction& instruction) {
    const Token name = tokens_.take();
    const auto* const info = std::find_if(std::begin(kOpcodes), std::end(kOpcodes),
                                          [&](const VertexOpcodeInfo& one) { return one.name == name.text; });
    if (info == std::end(kOpcodes)) return fail(name, "expected an instruction or END");
    if (info->since_1_1 && !is_1_1_) return fail(name, std::string(name.text) + " is of !!VP1.1");
    if (program_.instructions.size() == kVertexInstructions) return fail(name, "expected at most 128 instructions");
    instruction.opcode = info->opcode;
    if (info->opcode == VertexOpcode::arl ? !parse_address(instruction) : !parse_destination(instruction)) return false;
    for (int i = 0; i < info->operands; ++i) {
      if (!expect(",") || !parse_operand(instruction.operands[static_cast<std::size_t>(i)], info->scalar)) return false;
    }
    if (!expect(";")) return false;
    return check_reads(instruction, info->operands, name);
  }

  bool parse_address(VertexInstruction& instruction) {
    instruction.file = VertexFile::address;
    instruction.mask = 1;
    return expect("A0") && expect(".") && expect("x");
  }

  bool parse_destination(VertexInstruction& instruction) {
    const Token reg = tokens_.next();
    if (reg.text == "o" && program_.kind == VertexProgramKind::vertex) {
      if (!parse_output(instruction)) return false;
    } else if (reg.text == "c" && program_.kind == VertexProgramKind::state) {
      tokens_.take();
      instruction.file = VertexFile::parameter;
      if (!expect("[") || !parse_number(instruction.index, kVertexParameters) || !expect("]")) return false;
      writes_parameter_ = true;
    } else if (!parse_temporary(instruction.index)) {
      return fail(reg, program_.kind == VertexProgramKind::vertex ? "expected a register R0 to R11 or o[]"
                                                                  : "expected a register R0 to R11 or c[]");
    }
    return parse_mask(instruction.mask);
  }

  bool parse_output(VertexInstruction& instruction) {
    tokens_.take();
    if (!expect("[")) return false;
    const Token name = tokens_.take();
    const auto* const found = std::find(std::begin(kOutputNames), std::end(kOutputNames), name.text);
    if (found == std::end(kOutputNames)) return fail(name, "expected a name of a result");
    instruction.file = VertexFile::output;
    instruction.index = static_cast<int>(found - std::begin(kOutputNames));
    if (instruction.index == 0 && program_.position_invariant) {
      return fail(name, "o[HPOS] is not the program's with NV_position_invariant");
    }
    program_.outputs |= 1U << static_cast<unsigned>(instruction.index);
    return expect("]");
  }

  // R0 to R11.
  bool parse_temporary(int& index) {
    const std::string_view text = tokens_.next().text;
    if (text.size() < 2 || text.size() > 3 || text[0] != 'R' || !detail::is_digit(text[1])) return false;
    if (text.size() == 3 && (!detail::is_digit(text[2]) || text[1] == '0')) return false;
    index = text[1] - '0';
    if (text.size() == 3) index = 10 * index + text[2] - '0';
    if (index >= kVertexTemporaries) return false;
    tokens_.take();
    return true;
  }

  bool parse_number(int& number, int end) {
    const Token token = tokens_.take();
    const bool digits = !token.text.empty() && std::all_of(token.text.begin(), token.text.end(), detail::is_digit);
    number = 0;
    for (const char c : token.text) number = std::min(10 * number + (c - '0'), end);
    if (digits && number < end) return true;
    return fail(token, "expected a number from 0 to " + std::to_string(end - 1));
  }

  // ".x" to ".xyzw" in this order, or nothing.
  bool parse_mask(unsigned& mask) {
    if (!tokens_.accept(".")) return true;
    const Token token = tokens_.take();
    mask = 0;
    for (const char c : token.text) {
      const std::size_t component = std::string_view("xyzw").find(c);
      if (component > 3 || (mask >> component) != 0) return fail(token, "expected components of xyzw in their order");
      mask |= 1U << component;
    }
    if (mask == 0) return fail(token, "expected components of xyzw in their order");
    return true;
  }

  bool parse_operand(VertexOperand& operand, bool scalar) {
    operand.negated = tokens_.accept("-");
    const Token reg = tokens_.next();
    bool parsed = false;
    if (reg.text == "v") {
      parsed = parse_attribute(operand);
    } else if (reg.text == "c") {
      parsed = parse_parameter(operand);
    } else {
      parsed = parse_temporary(operand.index) || fail(reg, "expected a register R0 to R11, v[] or c[]");
    }
    return parsed && parse_swizzle(operand, scalar);
  }

  bool parse_swizzle(VertexOperand& operand, bool scalar) {
    const Token dot = tokens_.next();
    if (!tokens_.accept(".")) return !scalar || fail(dot, "expected one component");
    const Token token = tokens_.take();
    const std::size_t size = token.text.size();
    if (size != 1 && (size != 4 || scalar)) {
      return fail(token, scalar ? "expected one component" : "expected one component or four");
    }
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t component = std::string_view("xyzw").find(token.text[size == 1 ? 0 : i]);
      if (component > 3) return fail(token, "expected components of xyzw");
      operand.swizzle[i] = static_cast<std::uint8_t>(component);
    }
    return true;
  }

  bool parse_attribute(VertexOperand& operand) {
    tokens_.take();
    operand.file = VertexFile::attribute;
    if (!expect("[")) return false;
    const Token name = tokens_.next();
    const auto* const found = std::find(std::begin(kAttributeNames), std::end(kAttributeNames), name.text);
    if (found != std::end(kAttributeNames) && !name.text.empty()) {
      tokens_.take();
      operand.index = static_cast<int>(found - std::begin(kAttributeNames));
    } else if (!parse_number(operand.index, kVertexAttributes)) {
      fault_.message = "expected an attribute: 0 to 15 or its name";
      return false;
    }
    if (program_.kind == VertexProgramKind::state && operand.index != 0) {
      return fail(name, "a state program reads v[0] alone");
    }
    program_.attributes |= 1U << static_cast<unsigned>(operand.index);
    return expect("]");
  }

  bool parse_parameter(VertexOperand& operand) {
    tokens_.take();
    operand.file = VertexFile::parameter;
    if (!expect("[")) return false;
    if (!tokens_.accept("A0")) {
      if (!parse_number(operand.index, kVertexParameters)) return false;
      program_.parameters[static_cast<std::size_t>(operand.index)] = true;
      return expect("]");
    }
    operand.file = VertexFile::relative_parameter;
    program_.reads_relative = true;
    if (!expect(".") || !expect("x")) return false;
    if (tokens_.accept("+")) {
      if (!parse_number(operand.index, 64)) return false;
    } else if (tokens_.accept("-")) {
      if (!parse_number(operand.index, 65)) return false;
      operand.index = -operand.index;
    }
    return expect("]");
  }

  // One instruction reads at most one parameter and one attribute, each as often as it likes.
  bool check_reads(const VertexInstruction& instruction, int operands, const Token& at) {
    const auto is_parameter = [](const VertexOperand& o) {
      return o.file == VertexFile::parameter || o.file == VertexFile::relative_parameter;
    };
    for (std::size_t i = 0; i < static_cast<std::size_t>(operands); ++i) {
      for (std::size_t k = 0; k < i; ++k) {
        const VertexOperand &a = instruction.operands[k], &b = instruction.operands[i];
        const bool differ = a.file != b.file || a.index != b.index;
        if (is_parameter(a) && is_parameter(b) && differ) return fail(at, "it reads two parameters");
        const bool attributes = a.file == VertexFile::attribute && b.file == VertexFile::attribute;
        if (attributes && differ) return fail(at, "it reads two attributes");
      }
    }
    return true;
  }

  // What shows at the end of a program alone is at the position of its length.
  bool check_results() {
    const Token end{.text = {}, .position = tokens_.size()};
    if (program_.kind == VertexProgramKind::state) {
      return writes_parameter_ || fail(end, "a state program writes a parameter");
    }
    return program_.position_invariant || (program_.outputs & 1) != 0 || fail(end, "o[HPOS] is not written");
  }

  Tokens tokens_;
  bool is_1_1_;
  VertexFault& fault_;
  VertexProgram program_{};
  bool writes_parameter_ = false;
};

}  // namespace

const VertexOpcodeInfo& info_of(VertexOpcode opcode) {
  return kOpcodes[static_cast<std::size_t>(opcode)];
}

std::optional<VertexProgram> parse_vertex_program(std::string_view text, VertexProgramKind kind, bool allows_1_1,
                                                  VertexFault& fault) {
  text = text.substr(0, text.find('\0'));  // some programs count it
  const auto parse = [&](std::string_view header, bool is_1_1) {
    return Parser(text, header.size(), kind, is_1_1, fault).parse();
  };
  constexpr std::string_view kVertex10 = "!!VP1.0", kVertex11 = "!!VP1.1", kState10 = "!!VSP1.0";
  const bool is_vertex = kind == VertexProgramKind::vertex;
  if (is_vertex && text.starts_with(kVertex10)) return parse(kVertex10, false);
  if (is_vertex && allows_1_1 && text.starts_with(kVertex11)) return parse(kVertex11, true);
  if (!is_vertex && text.starts_with(kState10)) return parse(kState10, false);
  fault = {.position = 0, .message = std::string("expected ") + (is_vertex ? "!!VP1.0" : "!!VSP1.0")};
  if (is_vertex && allows_1_1) fault.message += " or !!VP1.1";
  return std::nullopt;
}

}  // namespace ninebit::gl_layer
