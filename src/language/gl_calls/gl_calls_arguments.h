// Reads the arguments of GL calls: numbers, enumerants and arrays, in C's words or those of other languages.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "ninebit/language/source_text.h"
#include "src/language/c_like/c_lexer.h"
#include "src/language/gl_calls/gl_calls_execute.h"
#include "src/language/source/source_faults.h"

namespace ninebit::detail {

inline constexpr std::size_t kMostGlValues = 1024;

// Look-ahead in texts of GL calls.
class GlLexer : public code::TokenReader {
 public:
  using TokenReader::TokenReader;

  // Whether the next token is followed by . -> or :: and a name, directly.
  [[nodiscard]] bool next_is_member() const;
  // Whether the next token, a name, is followed by a parenthesis, with <…> of a named cast between them or without.
  [[nodiscard]] bool next_is_call() const;
  // Whether the next token is followed by = alone.
  [[nodiscard]] bool next_is_assignment() const;
  // Whether the next tokens are (TYPE[, as of a compound literal.
  [[nodiscard]] bool begins_array_type() const;
  // Whether the next tokens are (* and a name.
  [[nodiscard]] bool begins_pointer_call() const;
  // Whether the next token, a name, is followed by a parenthesis and the name of a GL call.
  [[nodiscard]] bool wraps_call() const;
  // Skips (TYPE) or (const TYPE*) before an operand; whether it was there.
  bool skip_cast();

 private:
  [[nodiscard]] code::TokenReader behind_next() const;
};

class GlArgumentReader {
 public:
  enum class Read {
    done,
    unknown,  // a fault was reported; parsing can continue
    broken    // a fault was reported; the rest of the statement must be skipped
  };

  GlArgumentReader(const SourceText& source, GlLexer& lexer, SourceFaults& faults)
      : source_(source), lexer_(lexer), faults_(faults) {}

  Read argument(GlArgument& out);
  // "[4]" or "[]".
  bool bounds(std::optional<std::size_t>& size);
  // "{1, 0.5f, …}", or "[1, 0.5, …]" of a dump. An array with bounds is padded with zeros.
  bool braces(GlArgument& array, std::optional<std::size_t> size);
  // Makes a name mean an array; false: it does already.
  bool declare(std::string_view name, GlArgument array);
  // Skips gl., ext->, vtkgl:: and the like before a name; whether there was one.
  bool qualifier();

  bool expect(std::string_view mark);
  // From now on, enumerants of texture shaders are known, too.
  void read_stage_names(bool reads) { reads_stage_names_ = reads; }
  // Reports what was found instead; false, or broken.
  bool expected(const std::string& what);
  Read broken(const std::string& what) { return expected(what) ? Read::done : Read::broken; }

 private:
  void skip_casts();
  Read new_array(GlArgument& out);
  bool compound_literal(GlArgument& out);
  Read address(GlArgument& out);
  Read converted(GlArgument& out);
  Read scalar(GlArgument& out);
  Read term(GlArgument& out);
  Read enumerant(GlArgument& out);
  void place(GlArgument& out, std::size_t offset) const;

  SourceText source_;
  GlLexer& lexer_;
  SourceFaults& faults_;
  std::map<std::string_view, GlArgument> arrays_;
  int depth_ = 0;
  bool reads_stage_names_ = false;
};

}  // namespace ninebit::detail
