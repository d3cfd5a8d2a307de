#include <algorithm>
#include <map>
#include <utility>

#include "ninebit/language/smt_lib.h"
#include "src/language/emit/emit_program.h"

namespace ninebit {
namespace {

using emit::Interval;
using emit::Node;
using emit::Opcode;
using emit::V;

// Bits of the two's complement numbers that hold an interval.
int bits_of(Interval r) {
  int bits = 1;
  while (r.low < -(std::int64_t{1} << (bits - 1)) || r.high > (std::int64_t{1} << (bits - 1)) - 1) ++bits;
  return bits;
}

// Writes definitions, one a node; nodes that mean the same get one definition.
class Writer {
 public:
  // A value that is written: its symbol, and its interval, which gives its width.
  struct Term {
    std::string text;
    Interval range;
  };

  // Writes all that the value needs.
  Term term(const V& v) {
    if (v.is_constant()) return {constant(v.constant, bits_of(v.range())), v.range()};
    if (const auto at = written_.find(v.node); at != written_.end()) return at->second;
    return written_[v.node] = define((*v.graph)[v.node]);
  }

  // Both as numbers of one width.
  static std::string compare(const char* operation, const Term& a, const Term& b) {
    const int bits = bits_of(either(a.range, b.range));
    return std::string("(") + operation + ' ' + widen(a, bits) + ' ' + widen(b, bits) + ')';
  }

  [[nodiscard]] const std::string& out() const { return out_; }
  [[nodiscard]] const std::vector<std::string>& inputs() const { return inputs_; }

 private:
  static std::string constant(std::int64_t value, int bits) {
    return "(_ bv" + std::to_string(static_cast<std::uint64_t>(value) & ((std::uint64_t{1} << bits) - 1)) + ' ' +
           std::to_string(bits) + ')';
  }

  static std::string widen(const Term& term, int bits) {
    const int more = bits - bits_of(term.range);
    return more == 0 ? term.text : "((_ sign_extend " + std::to_string(more) + ") " + term.text + ')';
  }

  std::string symbol() { return 't' + std::to_string(next_++); }

  // The symbol of an expression; the same expression has one symbol.
  Term named(const std::string& expression, Interval range) {
    const auto [at, is_new] = symbols_.try_emplace(expression);
    if (is_new) {
      at->second = symbol();
      out_ +=
          "(define-fun " + at->second + " () (_ BitVec " + std::to_string(bits_of(range)) + ") " + expression + ")\n";
    }
    return {at->second, range};
  }

  Term operation(const char* name, Term a, Term b, Interval range) {
    const int bits = bits_of(range);
    std::string x = widen(a, bits), y = widen(b, bits);
    const bool commutes = std::string_view(name) != "bvsub";
    if (commutes && y < x) std::swap(x, y);
    return named(std::string("(") + name + ' ' + x + ' ' + y + ')', range);
  }

  // A sum, a difference or a product is computed at the width of the widest of its operands and its result.
  Term arithmetic(const char* name, const Node& node) {
    const Term a = term(node.args[0]), b = term(node.args[1]);
    Term wide = operation(name, a, b, either(node.range, either(a.range, b.range)));
    return narrowed(wide, node.range);
  }

  Term narrowed(const Term& wide, Interval range) {
    const int bits = bits_of(range);
    if (bits == bits_of(wide.range)) return {wide.text, range};
    return named("((_ extract " + std::to_string(bits - 1) + " 0) " + wide.text + ')', range);
  }

  Term choose(const std::string& condition, const Term& yes, const Term& no, Interval range) {
    const Interval both = either(range, either(yes.range, no.range));
    const int bits = bits_of(both);
    return narrowed(named("(ite " + condition + ' ' + widen(yes, bits) + ' ' + widen(no, bits) + ')', both), range);
  }

  // n = d·quotient + rest with 0 <= rest < d: both are unknowns that this determines.
  Term divide(const Term& n, std::int64_t d, Interval range) {
    const std::string key = n.text + " / " + std::to_string(d);
    const auto [at, is_new] = symbols_.try_emplace(key);
    if (!is_new) return {at->second, range};
    at->second = symbol();
    const Interval rests{0, d - 1}, all = either(n.range, Interval{0, d * (range.high + 1)});
    const Term quotient{at->second, range}, rest{symbol(), rests}, divisor{constant(d, bits_of({d, d})), {d, d}};
    const auto declare = [&](const Term& t) {
      const Term high{constant(t.range.high, bits_of({0, t.range.high})), {0, t.range.high}};
      const Term zero{constant(0, 1), {0, 0}};
      out_ += "(declare-const " + t.text + " (_ BitVec " + std::to_string(bits_of(t.range)) + "))\n(assert " +
              compare("bvsle", zero, t) + ")\n(assert " + compare("bvsle", t, high) + ")\n";
    };
    declare(quotient);
    declare(rest);
    const int bits = bits_of(all);
    out_ += "(assert (= " + widen(n, bits) + " (bvadd (bvmul " + widen(quotient, bits) + ' ' + widen(divisor, bits) +
            ") " + widen(rest, bits) + ")))\n";
    return quotient;
  }

  Term input(const Node& node) {
    inputs_.push_back(node.name);
    const std::string name = '|' + node.name + '|';
    out_ += "(declare-const " + name + " (_ BitVec 8))\n";
    return named("(concat #b0 " + name + ')', node.range);
  }

  Term define(const Node& node) {
    switch (node.opcode) {
      case Opcode::input:
        return input(node);
      case Opcode::add:
        return arithmetic("bvadd", node);
      case Opcode::sub:
        return arithmetic("bvsub", node);
      case Opcode::mul:
        return arithmetic("bvmul", node);
      case Opcode::min_of:
      case Opcode::max_of: {
        const Term a = term(node.args[0]), b = term(node.args[1]);
        return choose(compare(node.opcode == Opcode::min_of ? "bvsle" : "bvsge", a, b), a, b, node.range);
      }
      case Opcode::abs_of:
        return with_sign(node.args[0], node.args[0], node.range);
      case Opcode::divide:
        return divide(term(node.args[0]), node.args[1].constant, node.range);
      case Opcode::negate_where_negative:
        return with_sign(node.args[0], node.args[1], node.range);
      case Opcode::sum_of_components:  // of vectors, which these programs do not have
        break;
      case Opcode::select_where_at_least:
        break;
    }
    const Term v = term(node.args[0]), limit = term(node.args[1]), yes = term(node.args[2]), no = term(node.args[3]);
    return choose(compare("bvsge", v, limit), yes, no, node.range);
  }

  // sign < 0 ? -x : x
  Term with_sign(const V& sign, const V& x, Interval range) {
    const Term s = term(sign), value = term(x), zero{constant(0, 1), {0, 0}};
    const Interval both = either(value.range, Interval{-value.range.high, -value.range.low});
    return choose(compare("bvslt", s, zero), operation("bvsub", zero, value, both), value, range);
  }

  std::map<int, Term> written_;                 // by node
  std::map<std::string, std::string> symbols_;  // of expressions
  std::vector<std::string> inputs_;
  std::string out_;
  int next_ = 0;
};

V start_of(const SmtSource& source, emit::Graph& graph) {
  if (source.input.empty()) return emit::set(source.code);
  return emit::divide(graph.input(source.input, {0, 255}), 1 << source.byte_shift);
}

}  // namespace

Result<SmtQuestion> emit_smt_lib(const SmtProgram& a, const SmtProgram& b, int component) {
  emit::Graph graph(emit::Graph::Purpose::formulas);
  std::vector<V> results;
  for (const SmtProgram* side : {&a, &b}) {
    if (auto fault = emit::refusal(*side->program, "question")) return *fault;
    const auto start = [&](Register r, int i) {
      return start_of(side->start[static_cast<std::size_t>(r)][static_cast<std::size_t>(i)], graph);
    };
    const auto constant = [&](Register r, int stage, int i) {
      const Program& program = *side->program;
      const std::size_t which = r == Register::constant0 ? 0 : 1;
      const auto read = [&](const auto& from) {
        if (from.unset[which]) return start_of(side->unset[*from.unset[which]][static_cast<std::size_t>(i)], graph);
        return emit::set((which == 0 ? from.constant0 : from.constant1)[static_cast<std::size_t>(i)]);
      };
      return stage == kMaxGeneralCombiners ? read(program) : read(program.general[static_cast<std::size_t>(stage)]);
    };
    results.push_back(emit::list_program(*side->program, start, constant).result[static_cast<std::size_t>(component)]);
  }
  if (graph.negative_division()) return Diagnostic{.message = "the profile's codes are out of the datapath's range"};
  Writer writer;
  const Writer::Term x = writer.term(results[0]), y = writer.term(results[1]);
  SmtQuestion question;
  question.trivial = x.text == y.text;
  question.inputs = writer.inputs();
  if (question.trivial) return question;
  question.text =
      "(set-logic QF_BV)\n" + writer.out() + "(assert (not " + Writer::compare("=", x, y) + "))\n(check-sat)\n";
  if (question.inputs.empty()) return question;
  question.text += "(get-value (";
  for (const std::string& name : question.inputs) question.text += '|' + name + "| ";
  question.text.back() = ')';
  question.text += ")\n";
  return question;
}

}  // namespace ninebit
