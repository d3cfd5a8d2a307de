// From listed values to lines of a C-like language: names for what is used twice, parentheses, and the helpers needed.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "src/language/emit/emit_program.h"

namespace ninebit::emit {

// The words in which GLSL and C differ.
struct Dialect {
  std::string type;       // of a scalar
  std::string min_of;     // functions of two arguments
  std::string max_of;     //
  std::string clamp;      // of three: value, low, high
  std::string abs_of;     // of one
  std::string with_sign;  // of two: x < 0 ? -m : m
};

class Printer {
 public:
  Printer(const Graph& graph, const Listing& listing, const Dialect& dialect);

  // Declares a listed value, or says in a comment which known value it is.
  void line(const Line& line);
  // Makes a value ready for text(): declares what it needs first.
  void prepare(const V& v, const std::string& name_of_parts);
  void comment(const std::string& text) { out_ += "  // " + text + '\n'; }
  void blank() { out_ += '\n'; }

  // The value as an operand that binds as strongly as a name.
  [[nodiscard]] std::string atom(const V& v) { return text(v, kAtom); }

  [[nodiscard]] const std::string& out() const { return out_; }
  // The functions of the dialect that were called.
  [[nodiscard]] const std::set<std::string>& called() const { return called_; }
  // The texts of the inputs that were read.
  [[nodiscard]] const std::set<std::string>& inputs() const { return inputs_; }
  // The interval of all values, inner ones included.
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
  std::vector<std::string> names_;  // of nodes that have been declared
  std::set<std::string> taken_;
  std::set<std::string> called_, inputs_;
  Interval range_;
  std::string out_;
};

// The statements of the whole body: blocks, then the final combiner. Ends before the result is handed over.
void print_body(Printer& printer, const Listing& listing);

// A sentence for the emitted comment.
std::string range_comment(const Printer& printer);

// Why the printed values cannot be trusted to 32 bits; empty: they can.
std::optional<Diagnostic> refusal(const Printer& printer, const Graph& graph);

}  // namespace ninebit::emit
