// Registers of pixel shaders as they are written.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "src/language/pixel_shader/shader_instruction.h"
#include "src/language/pixel_shader/shader_macros.h"

namespace ninebit::detail {

// A position in a shader's tokens; the last token is Kind::end.
class ShaderCursor {
 public:
  explicit ShaderCursor(const std::vector<ShaderToken>& tokens) : tokens_(tokens) {}

  [[nodiscard]] const ShaderToken& peek() const { return tokens_[at_]; }
  const ShaderToken& take() { return tokens_[at_ + 1 < tokens_.size() ? at_++ : at_]; }
  // Takes the next token if it is this punctuation.
  bool take_if(char c) {
    if (!peek().is(c)) return false;
    take();
    return true;
  }
  [[nodiscard]] bool at_line_end() const {
    return peek().kind == ShaderToken::Kind::end_of_line || peek().kind == ShaderToken::Kind::end;
  }
  [[nodiscard]] bool at_end() const { return peek().kind == ShaderToken::Kind::end; }

 private:
  const std::vector<ShaderToken>& tokens_;
  std::size_t at_ = 0;
};

// The number of registers of a file.
[[nodiscard]] int registers_of(ShaderFile file, const ShaderVersion& version);

// Reads operands of one version; functions that return nothing have reported a fault.
class ShaderOperandReader {
 public:
  ShaderOperandReader(ShaderCursor& in, const ShaderVersion& version, bool includes, SourceFaults& faults)
      : in_(in), version_(version), includes_(includes), faults_(faults) {}

  std::optional<ShaderTarget> target();
  std::optional<ShaderOperand> operand();
  // A texture instruction's operand, which is not the combiners': t0_bx2, c0, and t0_dw.xyw of ps.1.4.
  std::optional<ShaderOperand> coordinates();
  // Reports what was found in place of `what`.
  void expected(const std::string& what);
  // "; an included file may define it", or empty.
  [[nodiscard]] std::string may_be_included() const;

 private:
  struct Register {
    std::size_t offset = 0;
    std::string_view text{};
    ShaderFile file = ShaderFile::zero;
    int index = 0;
    std::string modifiers{};               // with their underscores, in lower case
    std::string suffix{};                  // after the dot, in lower case
    std::optional<std::string> unknown{};  // why the register does not exist
  };
  std::optional<Register> read_register();
  bool read_index(Register& out);
  bool name_register(Register& out, const std::string& name);
  bool check_index(Register& out);
  bool read_suffix(Register& out);
  // A number that Cxbx prints where the words have zero, one or a half.
  std::optional<ShaderOperand> printed_number(ShaderOperand out);
  bool apply_modifiers(ShaderOperand& out, const Register& from);
  bool apply_selector(ShaderOperand& out, const Register& from);

  ShaderCursor& in_;
  const ShaderVersion& version_;
  bool includes_;
  SourceFaults& faults_;
};

}  // namespace ninebit::detail
