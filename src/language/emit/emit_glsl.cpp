#include "ninebit/language/glsl.h"
#include "src/language/emit/emit_printer.h"

namespace ninebit {

namespace {

std::string_view head_of(GlslVersion version) {
  switch (version) {
    case GlslVersion::glsl_130:
      return "#version 130\n";
    case GlslVersion::glsl_330:
      return "#version 330 core\n";
    case GlslVersion::es_300:
      break;
  }
  return "#version 300 es\nprecision highp int;\n";
}

enum class Constants : bool { literal, uniform };

Result<std::string> glsl_text(const Program& program, GlslVersion version, std::string_view function,
                              Constants constants) {
  using namespace emit;  // NOLINT(google-build-using-namespace)
  if (auto fault = refusal(program, function)) return *fault;
  const std::string name(function), array = name + "_constants";
  Graph graph;
  const auto component_of = [&](const std::string& value, int component) {
    return any_code(program, graph, value + '.' + kComponentLetters[static_cast<std::size_t>(component)]);
  };
  ConstantValue constant;
  if (constants == Constants::uniform) {
    constant = [&](Register r, int stage, int component) {
      return component_of(array + '[' + std::to_string(2 * stage + (r == Register::constant1 ? 1 : 0)) + ']',
                          component);
    };
  }
  const Listing listing = list_program(
      program,
      [&](Register r, int component) {
        if (r == Register::spare0) return any_code(program, graph, "spare0_alpha");
        return component_of(std::string(short_name_of(r)), component);
      },
      constant);
  const Dialect dialect{"int", "min", "max", "clamp", "abs", name + "_with_sign"};
  Printer printer(graph, listing, dialect);
  print_body(printer, listing);
  std::string result;
  for (const V& v : listing.result) result += (result.empty() ? "" : ", ") + printer.atom(v);
  if (auto fault = refusal(printer, graph)) return *fault;

  std::string out(head_of(version));
  out += '\n' + codes_comment(program.datapath) + ".\n// " + range_comment(printer) + '\n';
  if (constants == Constants::uniform) {
    out += "\nuniform ivec4 " + array + '[' + std::to_string(kGlslConstants) + "];\n";
  }
  if (printer.called().count(dialect.with_sign) != 0) {
    out += "\nint " + dialect.with_sign + "(int n, int magnitude) {\n  return n < 0 ? -magnitude : magnitude;\n}\n";
  }
  out += "\nivec4 " + name + "(ivec4 primary, ivec4 secondary, ivec4 fog, ivec4 texture0, ivec4 texture1,\n" +
         std::string(name.size() + 7, ' ') + "ivec4 texture2, ivec4 texture3, int spare0_alpha) {\n";
  out += printer.out();
  return out + "  return ivec4(" + result + ");\n}\n";
}

}  // namespace

Result<std::string> emit_glsl(const Program& program, GlslVersion version, std::string_view function) {
  return glsl_text(program, version, function, Constants::literal);
}

Result<std::string> emit_glsl_with_uniform_constants(const Program& program, GlslVersion version,
                                                     std::string_view function) {
  return glsl_text(program, version, function, Constants::uniform);
}

}  // namespace ninebit
