#include "ninebit/language/c_source.h"
#include "src/language/emit/emit_printer.h"

namespace ninebit {
namespace {

// The definitions of the helper functions that were called; none calls another.
std::string helpers_of(const emit::Printer& printer, const emit::Dialect& dialect) {
  std::string out;
  const auto helper = [&](const std::string& name, const char* parameters, const char* value) {
    if (printer.called().count(name) == 0) return;
    out += "\nstatic int32_t " + name + "(" + parameters + ") {\n  return " + value + ";\n}\n";
  };
  helper(dialect.min_of, "int32_t a, int32_t b", "a < b ? a : b");
  helper(dialect.max_of, "int32_t a, int32_t b", "a > b ? a : b");
  helper(dialect.clamp, "int32_t x, int32_t low, int32_t high", "x < low ? low : x > high ? high : x");
  helper(dialect.abs_of, "int32_t x", "x < 0 ? -x : x");
  helper(dialect.with_sign, "int32_t n, int32_t magnitude", "n < 0 ? -magnitude : magnitude");
  return out;
}

}  // namespace

Result<std::string> emit_c(const Program& program, std::string_view function) {
  using namespace emit;  // NOLINT(google-build-using-namespace)
  if (auto fault = refusal(program, function)) return *fault;
  const std::string name(function);
  Graph graph;
  const Listing listing = list_program(program, [&](Register r, int component) {
    if (r == Register::spare0) return any_code(program, graph, "spare0_alpha");
    return any_code(program, graph, std::string(short_name_of(r)) + '[' + std::to_string(component) + ']');
  });
  const Dialect dialect{"const int32_t", name + "_min", name + "_max",
                        name + "_clamp", name + "_abs", name + "_with_sign"};
  Printer printer(graph, listing, dialect);
  print_body(printer, listing);
  std::string result;
  for (std::size_t i = 0; i < 4; ++i) {
    result += "  result[" + std::to_string(i) + "] = " + printer.atom(listing.result[i]) + ";\n";
  }
  if (auto fault = refusal(printer, graph)) return *fault;

  const std::string indent(name.size() + 6, ' ');
  std::string out =
      "#include <stdint.h>\n\n" + codes_comment(program.datapath) + "; arrays are red, green, blue, alpha.\n";
  out += "// " + range_comment(printer) + '\n' + helpers_of(printer, dialect);
  out += "\nvoid " + name + "(const int32_t primary[4], const int32_t secondary[4], const int32_t fog[4],\n" + indent +
         "const int32_t texture0[4], const int32_t texture1[4], const int32_t texture2[4],\n" + indent +
         "const int32_t texture3[4], int32_t spare0_alpha, int32_t result[4]) {\n";
  for (const Register r : {Register::primary, Register::secondary, Register::fog, Register::texture0,
                           Register::texture1, Register::texture2, Register::texture3}) {
    const std::string argument(short_name_of(r));
    const auto next = printer.inputs().lower_bound(argument + '[');
    const bool read = next != printer.inputs().end() && next->compare(0, argument.size() + 1, argument + '[') == 0;
    if (!read) out += "  (void)" + argument + ";\n";
  }
  if (printer.inputs().count("spare0_alpha") == 0) out += "  (void)spare0_alpha;\n";
  return out + '\n' + printer.out() + result + "}\n";
}

}  // namespace ninebit
