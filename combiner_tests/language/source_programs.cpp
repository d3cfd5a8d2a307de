#include "combiner_tests/language/source_programs.h"

#include <vector>

namespace ninebit::test {
namespace {

struct Variable {
  std::string name;
  std::string type;
};

const std::vector<std::string> kTypes{"char",     "signed char",    "unsigned char",
                                      "short",    "unsigned short", "int",
                                      "unsigned", "long long",      "unsigned long long",
                                      "float",    "double",         "_Bool",
                                      "GLubyte",  "GLint",          "GLfloat",
                                      "enum E#",  "GLenum",         "long"};

bool is_real(const std::string& type) {
  return type == "float" || type == "double" || type == "GLfloat";
}

class Writer {
 public:
  Writer(Random& random, int index) : random_(random), index_(std::to_string(index)) {}

  std::string program() {
    std::string text = "enum E" + index_ + " { P" + index_ + " = 2, Q" + index_ + ", R" + index_ + " = 9 };\n";
    text += "struct S" + index_ + " { " + type() + " a; float b[4]; " + type() +
            " c; struct { short d; unsigned char e; } in; };\n";
    text += "#define M" + index_ + "(x, y) ((x) > (y) ? (x) : (y))\n";
    text += "#define W" + index_ + "(p, v) do { (p)[0] = (v); (p)[1] = (p)[0] / 2; } while (0)\n";
    text += "static const float t" + index_ + "[4] = {0.5f, 3, 7.25f, 1e-3f};\n";
    text += "static const unsigned char u" + index_ + "[4] = {255, 128, 7};\n";
    uses_unknown_ = random_.one_in(3);
    text += helper();
    text += "void run_" + index_ + "(void)\n{\n";
    in_entry_ = true;
    variables_.clear();
    body(text, 9);
    outputs(text);
    return text + "}\n";
  }

 private:
  std::string name(const char* prefix) { return prefix + std::to_string(next_++); }
  int below(int count) { return random_.below(count); }
  template <class T>
  const T& any(const std::vector<T>& all) {
    return all[static_cast<std::size_t>(below(static_cast<int>(all.size())))];
  }
  std::string type() {
    std::string out = any(kTypes);
    if (const std::size_t at = out.find('#'); at != std::string::npos) out.replace(at, 1, index_);
    return out;
  }

  std::string constant() {
    static const std::vector<std::string> kAll{"0",     "1",   "2",          "3",    "7",          "-1",  "100",
                                               "255",   "256", "0x80",       "'A'",  "40000",      "1u",  "5ul",
                                               "0.5f",  "0.1", "2.5",        "1e2f", "3.0f",       ".25", "1 << 10",
                                               "65535", "0.7", "0x7fffffff", "017",  "4294967295u"};
    if (random_.one_in(8)) return std::string(1, "PQR"[below(3)]) + index_;
    return any(kAll);
  }

  // A variable's value, an element's, a member's, a call's.
  std::string operand(int depth) {
    const int kind = below(12);
    if (kind < 4 && !variables_.empty()) {
      return any(variables_).name;
    }
    if (kind == 4 && !arrays_.empty()) {
      return any(arrays_).name + "[(" + integer(depth - 1) + ") & 3]";
    }
    if (kind == 5) return (random_.one_in(2) ? "t" : "u") + index_ + "[(" + integer(depth - 1) + ") & 3]";
    if (kind == 6 && !structs_.empty()) return member(depth);
    if (kind == 7 && in_entry_) return "h" + index_ + "(" + expression(depth - 1) + ", " + expression(depth - 1) + ")";
    if (kind == 8 && uses_unknown_ && random_.one_in(3)) return "program_unknown()";
    if (kind == 9 && !pointers_.empty()) return "*" + any(pointers_).name;
    return "(" + constant() + ")";
  }

  std::string member(int depth) {
    const std::string object = any(structs_).name;
    switch (below(4)) {
      case 0:
        return object + ".a";
      case 1:
        return object + ".b[(" + integer(depth - 1) + ") & 3]";
      case 2:
        return object + ".c";
      default:
        return object + (random_.one_in(2) ? ".in.d" : ".in.e");
    }
  }

  std::string expression(int depth) {
    if (depth <= 0) return random_.one_in(2) ? "(" + constant() + ")" : operand(0);
    const std::string a = expression(depth - 1);
    switch (below(15)) {
      case 0:
      case 1:
        return "(" + a + " + " + expression(depth - 1) + ")";
      case 2:
        return "(" + a + " - " + expression(depth - 1) + ")";
      case 3:
      case 4:
        return "(" + a + " * " + expression(depth - 1) + ")";
      case 5:
        return "(" + a + " / ((" + integer(depth - 1) + " & 7) + 1))";
      case 6:
        return "(" + a + " / 4.0f)";
      case 7:
        return "(" + a + (random_.one_in(2) ? " < " : " >= ") + expression(depth - 1) + " ? " + expression(depth - 1) +
               " : " + expression(depth - 1) + ")";
      case 8:
        return "((" + type() + ")(" + a + "))";
      case 9:
        return "(" + integer(depth - 1) +
               (random_.one_in(4) ? " % ((" + integer(depth - 1) + " & 7) + 1))"
                                  : std::string(1, "&|^"[below(3)]) + integer(depth - 1) + ")");
      case 10:
        return "(" + integer(depth - 1) + (random_.one_in(2) ? " >> " : " << ") + "(" + integer(depth - 1) + " & 7))";
      case 11:
        return random_.one_in(2) ? "(-" + a + ")" : "(!" + a + ")";
      case 12:
        return "M" + index_ + "(" + a + ", " + operand(depth - 1) + ")";
      case 13:
        return "(" + a + (random_.one_in(2) ? " && " : " || ") + expression(depth - 1) + ")";
      default:
        return operand(depth);
    }
  }

  // An expression of an integer type.
  std::string integer(int depth) {
    static const std::vector<std::string> kIntegers{"int",       "unsigned", "short",      "unsigned char",
                                                    "long long", "GLint",    "signed char"};
    if (depth <= 0) return "(" + std::to_string(below(9)) + ")";
    return "((" + any(kIntegers) + ")" + expression(depth - 1) + ")";
  }

  std::string target(int depth) {
    const int kind = below(6);
    if (kind < 2 && !arrays_.empty()) {
      return any(arrays_).name + "[" + std::to_string(below(4)) + "]";
    }
    if (kind == 2 && !structs_.empty()) return member(depth);
    if (kind == 3 && !pointers_.empty()) return "*" + any(pointers_).name;
    if (!variables_.empty()) return any(variables_).name;
    return "";
  }

  void line(std::string& text, const std::string& what) {
    text += std::string(2 * static_cast<std::size_t>(level_), ' ') + what + "\n";
  }

  void declare(std::string& text) {
    const std::string type = this->type();
    switch (below(6)) {
      case 0: {
        const std::string own = name("a");
        line(text, type + " " + own + "[4] = {" + expression(1) + ", " + expression(1) + ", " + constant() + "};");
        arrays_.push_back({own, type});
        return;
      }
      case 1: {
        const std::string own = name("s");
        line(text, "struct S" + index_ + " " + own + " = {" + expression(1) + ", {1, 2.5f}, " + expression(1) + ", {" +
                       expression(1) + ", " + constant() + "}};");
        structs_.push_back({own, ""});
        return;
      }
      case 2:
        if (!variables_.empty()) {
          const Variable& to = any(variables_);
          const std::string own = name("p");
          line(text, to.type + " *" + own + " = &" + to.name + ";");
          pointers_.push_back({own, to.type});
          return;
        }
        [[fallthrough]];
      case 3:
        if (!arrays_.empty()) {
          const Variable& to = any(arrays_);
          const std::string own = name("p");
          line(text, to.type + " *" + own + " = " + to.name + " + " + std::to_string(below(4)) + ";");
          pointers_.push_back({own, to.type});
          return;
        }
        [[fallthrough]];
      default: {
        const std::string own = name("v");
        line(text, (random_.one_in(6) ? "static " + type + " " + own + " = " + constant()
                                      : type + " " + own + " = " + expression(2)) +
                       ";");
        variables_.push_back({own, type});
      }
    }
  }

  void statement(std::string& text, int depth) {
    const std::string to = target(1);
    const int kind = below(depth > 0 ? 16 : 7);
    if (kind < 3 || to.empty()) {
      if (to.empty() || random_.one_in(3)) return declare(text);
      return line(text, to + " = " + expression(2) + ";");
    }
    if (kind == 3)
      return line(text, to + (random_.one_in(2) ? " += " : random_.one_in(2) ? " -= " : " *= ") + expression(1) + ";");
    if (kind == 4) return line(text, random_.one_in(2) ? to + "++;" : "--" + to + ";");
    if (kind == 5) {
      if (uses_unknown_ && !arrays_.empty() && random_.one_in(4)) {
        const Variable& array = any(arrays_);
        if (is_real(array.type) && array.type != "double") return line(text, "program_writes(" + array.name + ");");
      }
      if (in_entry_ && !arrays_.empty()) {
        const Variable& array = any(arrays_);
        if (array.type == "float" || array.type == "GLfloat")
          return line(text, "k" + index_ + "(" + array.name + ", " + expression(1) + ");");
        return line(text, "W" + index_ + "(" + array.name + ", " + expression(1) + ");");
      }
      return line(text, to + " = (" + expression(1) + ", " + expression(1) + ");");
    }
    if (kind == 6) {
      if (structs_.size() > 1) return line(text, structs_[0].name + " = " + structs_.back().name + ";");
      if (!pointers_.empty() && !variables_.empty()) {
        const Variable& pointer = any(pointers_);
        for (const Variable& one : variables_) {
          if (one.type == pointer.type && random_.one_in(2)) return line(text, pointer.name + " = &" + one.name + ";");
        }
      }
      return line(text, to + " = " + expression(3) + ";");
    }
    nested(text, depth, kind);
  }

  void nested(std::string& text, int depth, int kind) {
    const std::string condition = uses_unknown_ && random_.one_in(3) ? "program_unknown() > 3" : expression(2);
    const std::string counter = name("i");
    if (kind < 10) {
      line(text, "if (" + condition + ") {");
      block(text, depth - 1);
      if (random_.one_in(2)) {
        line(text, "} else {");
        block(text, depth - 1);
      }
      return line(text, "}");
    }
    if (kind < 13) {
      const bool counts = !(uses_unknown_ && random_.one_in(4));
      line(text, "for (int " + counter + " = 0; " + counter + " < " +
                     (counts ? std::to_string(below(6)) : "(program_unknown() & 3)") + "; " + counter + "++) {");
      ++loops_;
      constants_of_loops(counter, text, depth);
      --loops_;
      return line(text, "}");
    }
    if (kind == 13) {
      line(text, "{ int " + counter + " = " + std::to_string(below(5)) + ";");
      line(text, random_.one_in(2) ? "while (" + counter + "-- > 0) {" : "do {");
      const bool is_do = text.ends_with("do {\n");
      ++loops_;
      block(text, depth - 1);
      --loops_;
      line(text, is_do ? "} while (" + counter + "-- > 0);" : "}");
      return line(text, "}");
    }
    line(text,
         "switch (" + (uses_unknown_ && random_.one_in(3) ? "program_unknown() & 3" : integer(2) + " & 3") + ") {");
    for (int label = 0; label < 3; ++label) {
      line(text, "case " + std::to_string(label) + ": {");
      block(text, depth - 1);
      line(text, "}");
      if (random_.one_in(2)) line(text, "  break;");
    }
    line(text, "default: {");
    block(text, depth - 1);
    line(text, "} }");
  }

  void constants_of_loops(const std::string& counter, std::string& text, int depth) {
    const std::size_t before = variables_.size();
    // The counter is read, not written: a target of its own would make the loop endless.
    ++level_;
    if (!variables_.empty()) line(text, any(variables_).name + " += " + counter + ";");
    --level_;
    block(text, depth - 1);
    variables_.resize(before);
  }

  void block(std::string& text, int depth) {
    const auto variables = variables_, arrays = arrays_, structs = structs_, pointers = pointers_;
    ++level_;
    const int count = 1 + below(3);
    for (int i = 0; i < count; ++i) statement(text, depth);
    if (loops_ > 0 && random_.one_in(5)) {
      line(text, std::string("if (") + (uses_unknown_ && random_.one_in(2) ? "program_unknown() & 1" : expression(1)) +
                     ") " + (random_.one_in(2) ? "break;" : "continue;"));
    }
    if (returns_ && random_.one_in(6)) line(text, "if (" + expression(1) + ") return " + expression(1) + ";");
    --level_;
    variables_ = variables;
    arrays_ = arrays;
    structs_ = structs;
    pointers_ = pointers;
  }

  void body(std::string& text, int count) {
    level_ = 1;
    for (int i = 0; i < 4; ++i) declare(text);
    for (int i = 0; i < count; ++i) statement(text, 2);
    level_ = 0;
  }

  // Functions that the program calls: one of values, one that writes an array.
  std::string helper() {
    const std::string first = type(), second = type();
    std::string text = "static " + type() + " h" + index_ + "(" + first + " x, " + second + " y)\n{\n";
    in_entry_ = false;
    returns_ = true;
    variables_ = {{"x", first}, {"y", second}};
    level_ = 1;
    for (int i = 0; i < 3; ++i) statement(text, 1);
    line(text, "return " + expression(2) + ";");
    returns_ = false;
    text += "}\nstatic void k" + index_ +
            "(float *p, float x)\n{\n  int i;\n  for (i = 0; i < 4; i++) p[i] = p[i] * 0.5f + x / (i + 1);\n";
    if (random_.one_in(2)) text += "  if (x > 1) return;\n  p[2] = x;\n";
    text += "}\n";
    variables_.clear();
    arrays_.clear();
    structs_.clear();
    pointers_.clear();
    return text;
  }

  void outputs(std::string& text) {
    level_ = 1;
    line(text, "float out[4];");
    for (int slot = 0; slot < 4; ++slot) {
      for (int i = 0; i < 4; ++i) {
        const std::string value = expression(2);
        const bool whole = random_.one_in(2);
        line(text, "out[" + std::to_string(i) +
                       "] = " + (whole ? "((" + integer_of(value) + ") & 255) / 256.0f;" : "(" + value + ") * 0.01f;"));
      }
      if (slot < 2) line(text, "glCombinerParameterfvNV(GL_CONSTANT_COLOR" + std::to_string(slot) + "_NV, out);");
      if (slot >= 2)
        line(text,
             "glCombinerStageParameterfvNV(GL_COMBINER" + std::to_string(slot) + "_NV, GL_CONSTANT_COLOR1_NV, out);");
    }
    level_ = 0;
  }
  std::string integer_of(const std::string& value) {
    return (random_.one_in(2) ? "(int)(" : "(long long)(") + value + ")";
  }

  Random& random_;
  std::string index_;
  std::vector<Variable> variables_, arrays_, structs_, pointers_;
  int next_ = 0, level_ = 0, loops_ = 0;
  bool in_entry_ = false, uses_unknown_ = false, returns_ = false;
};

}  // namespace

std::string programs_prologue() {
  return R"(
typedef unsigned GLenum; typedef int GLint; typedef unsigned char GLubyte; typedef float GLfloat;
enum { GL_CONSTANT_COLOR0_NV = 0x852A, GL_CONSTANT_COLOR1_NV = 0x852B, GL_COMBINER0_NV = 0x8550,
       GL_COMBINER2_NV = 0x8552, GL_COMBINER3_NV = 0x8553 };
float slots[18][4];
unsigned program_seed;
static int program_unknown(void) { program_seed = program_seed * 1103515245u + 12345u; return (program_seed >> 16) & 7; }
static void program_writes(float *p) { for (int i = 0; i < 4; i++) p[i] = program_unknown() * 0.125f; }
static void glCombinerParameterfvNV(GLenum name, const float *v) { for (int i = 0; i < 4; i++) slots[name - 0x852A][i] = v[i]; }
static void glCombinerStageParameterfvNV(GLenum stage, GLenum name, const float *v)
{ for (int i = 0; i < 4; i++) slots[2 + 2 * (stage - 0x8550) + (name - 0x852A)][i] = v[i]; }
)";
}

std::string random_program(Random& random, int index) {
  return Writer(random, index).program();
}

}  // namespace ninebit::test
