// Prints listed values as lines of a C-like language: variables for values that are used twice, parentheses, and the
// helpers needed.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "src/language/emit/emit_program.h"

namespace ninebit::emit {

// The words in which GLSL and C differ.
struct Dialect {
  std::string type;       // of a variable, "const int32_t"
  std::string min_of;     // function of (a, b)
  std::string max_of;     // function of (a, b)
  std::string clamp;      // function of (x, low, high)
  std::string abs_of;     // function of (x)
  std::string with_sign;  // function of (n, magnitude): n < 0 ? -magnitude : magnitude
  // Of languages with vectors of three, in which the functions above take them, too:
  std::string vector_type{};        // of a variable
  std::string splat_open{};         // what stands before a number that becomes a vector; behind it: ')'
  std::string sum_of_components{};  // function of (vector)
};

class Printer {
 public:
  // Prints what `results` need.
  Printer(const Graph& graph, const std::vector<V>& results, const Dialect& dialect);
  Printer(const Graph& graph, const Listing& listing, const Dialect& dialect)
      : Printer(graph, std::vector<V>(listing.result.begin(), listing.result.end()), dialect) {}

  // Declares a listed value, or writes a comment with the known value that it equals.
  void line(const Line& line);
  // Declares the variables that text() of this value needs.
  void prepare(const V& v, const std::string& name_of_parts);
  void comment(const std::string& text) { out_ += "  // " + text + '\n'; }
  // Adds a statement, without its semicolon.
  void statement(const std::string& text);
  void blank() { out_ += '\n'; }

  // The value as an operand, in parentheses unless it is a name, a constant or a call.
  [[nodiscard]] std::string atom(const V& v) { return text(v, kAtom); }
  // The value as a whole expression.
  [[nodiscard]] std::string whole(const V& v) { return text(v, kConditional); }
  // The same as a vector.
  [[nodiscard]] std::string vector(const V& v) {
    return v.is_vector() ? whole(v) : dialect_.splat_open + text(v, kConditional) + ')';
  }

  [[nodiscard]] const std::string& out() const { return out_; }
  // The functions of the dialect that were called.
  [[nodiscard]] const std::set<std::string>& called() const { return called_; }
  // The texts of the inputs that were read.
  [[nodiscard]] const std::set<std::string>& inputs() const { return inputs_; }
  // The interval of all values, including inner ones.
  [[nodiscard]] Interval range() const { return range_; }

 private:
  enum Strength { kConditional, kSum, kProduct, kAtom };
  struct Text {
    std::string text;
    Strength strength = kAtom;
  };

  void count(const V& v);
  [[nodiscard]] bool wants_name(int node) const;
  void declare(int index, const std::string& name_of_parts);
  Text expression(const V& v);
  Text operation(const Node& node);
  std::string text(const V& v, Strength least);
  std::string call(const std::string& function, std::initializer_list<V> args);

  const Graph& graph_;
  const Dialect& dialect_;
  std::vector<int> uses_;
  std::vector<std::string> names_;  // of declared nodes
  std::set<std::string> taken_;
  std::set<std::string> called_, inputs_;
  Interval range_;
  std::string out_;
};

// Prints the statements of the body: blocks, then the final combiner. The caller prints the result.
void print_body(Printer& printer, const Listing& listing);

// The first lines of a text, without the end of their sentence: what the codes of its arguments and of its result are.
std::string codes_comment(const Datapath& datapath);
// The range as a sentence for the emitted comment.
std::string range_comment(const Printer& printer);

// Why 32-bit integers cannot hold the printed values; empty: they can.
std::optional<Diagnostic> refusal(const Printer& printer, const Graph& graph);

}  // namespace ninebit::emit
