// Definitions as C: initializers of the struct, and assignments to its members.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "src/language/c_like/c_lexer.h"
#include "src/language/source/source_faults.h"
#include "src/language/xbox/xbox_expression.h"
#include "src/language/xbox/xbox_fields.h"

namespace ninebit::xbox {

class Parser {
 public:
  Parser(const SourceText& source, detail::SourceFaults& faults)
      : source_(source), tokens_(source.text, true), faults_(faults), values_(tokens_, faults) {}

  // Reads the whole text. Every fault is reported; reading goes on behind it.
  Definition parse();

  // How many words a positional initializer has, and where it begins; empty: there is none, or it has designators.
  struct Positional {
    std::size_t words = 0, offset = 0;
  };
  [[nodiscard]] const std::optional<Positional>& positional() const { return positional_; }

  // Calls of functions, such as CreatePixelShader, which were passed over.
  struct Call {
    std::string function{};
    std::size_t offset = 0;
  };
  [[nodiscard]] const std::vector<Call>& calls() const { return calls_; }

 private:
  // A member with its index as it is written: "psd->PSRGBInputs[1]".
  struct Target {
    std::string object{};  // "psd"; empty: none
    code::Token member{};
    std::optional<std::uint32_t> index{};
  };

  void statement();
  void declaration();
  void assignment(const code::Token& first);
  [[nodiscard]] std::optional<Target> target(const code::Token& first);
  void assign(const Field& field, const Target& target, bool adds_bits);
  // The words of a definition in braces, after '='.
  void initializer();
  void members(Positional& found, bool& designated);
  [[nodiscard]] std::optional<std::size_t> designator();
  void elements(const Field& field);

  [[nodiscard]] const Field* member(const code::Token& name);
  [[nodiscard]] std::optional<std::uint32_t> index();
  [[nodiscard]] bool fits(const Field& field, std::optional<std::uint32_t> index, std::size_t offset);
  void store(std::size_t word, std::uint32_t value, std::size_t offset, bool adds_bits = false);
  void check_object(const Target& target);
  bool expect(std::string_view mark, std::string_view where);
  void fault_here(const std::string& expected);
  [[nodiscard]] std::string line_of(std::size_t offset) const { return std::to_string(source_.place(offset).line); }
  [[nodiscard]] bool at_end() const { return tokens_.peek().kind == code::Token::Kind::end; }
  void clear(const code::Token& name);
  void skip_call();
  void skip_statement();
  void skip_value();

  SourceText source_;
  code::TokenReader tokens_;
  detail::SourceFaults& faults_;
  Expressions values_;
  Definition definition_{};
  std::optional<Target> first_target_{};
  std::optional<std::size_t> first_initializer_{};
  std::optional<Positional> positional_{};
  std::vector<Call> calls_{};
};

}  // namespace ninebit::xbox
