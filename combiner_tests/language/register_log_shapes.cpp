#include "combiner_tests/language/register_log_shapes.h"

#include <array>
#include <cstdio>
#include <utility>

#include "combiner_tests/combiner/random_state.h"

namespace ninebit::test {
namespace {

// Rows of NV20's words, as nxdk's and envytools' headers number them.
struct Row {
  const char* word;
  const char* method;
  std::uint32_t number;
  int count;
};
constexpr Row kRows[] = {
    {"RC_IN_ALPHA", "NV097_SET_COMBINER_ALPHA_ICW", 0x260, 8},
    {"RC_FINAL0", "NV097_SET_COMBINER_SPECULAR_FOG_CW0", 0x288, 1},
    {"RC_FINAL1", "NV097_SET_COMBINER_SPECULAR_FOG_CW1", 0x28c, 1},
    {"RC_CONSTANT_COLOR0", "NV097_SET_COMBINER_FACTOR0", 0xa60, 8},
    {"RC_CONSTANT_COLOR1", "NV097_SET_COMBINER_FACTOR1", 0xa80, 8},
    {"RC_OUT_ALPHA", "NV097_SET_COMBINER_ALPHA_OCW", 0xaa0, 8},
    {"RC_IN_RGB", "NV097_SET_COMBINER_COLOR_ICW", 0xac0, 8},
    {"RC_COLOR0", "NV097_SET_SPECULAR_FOG_FACTOR[0]", 0x1e20, 1},
    {"RC_COLOR1", "NV097_SET_SPECULAR_FOG_FACTOR[1]", 0x1e24, 1},
    {"RC_OUT_RGB", "NV097_SET_COMBINER_COLOR_OCW", 0x1e40, 8},
    {"RC_ENABLE", "NV097_SET_COMBINER_CONTROL", 0x1e60, 1},
    {"TEX_SHADER_OP", "NV097_SET_SHADER_STAGE_PROGRAM", 0x1e70, 1},
    {"VERTEX_BEGIN_END", "NV097_SET_BEGIN_END", 0x17fc, 1},
    {"VTXBUF_ELEMENT_U16", "NV097_ARRAY_ELEMENT16", 0x1800, 1},
    {"VTXBUF_BATCH", "NV097_DRAW_ARRAYS", 0x1810, 1},
    {"VTXBUF_DATA", "NV097_INLINE_ARRAY", 0x1818, 1},
    {"VTXBUF_FMT", "NV097_SET_VERTEX_DATA_ARRAY_FORMAT", 0x1760, 16},
    {"FLIP_INCR_WRITE", "NV097_FLIP_INCREMENT_WRITE", 0x12c, 1},
    {"FLIP_WAIT", "NV097_FLIP_STALL", 0x130, 1},
};

template <class... Values>
std::string format(const char* how, Values... values) {
  std::array<char, 300> text{};
  std::snprintf(text.data(), text.size(), how, values...);
  return text.data();
}

const Row* row_of(std::uint32_t method) {
  for (const Row& row : kRows) {
    if (method >= row.number && method < row.number + 4 * static_cast<std::uint32_t>(row.count)) return &row;
  }
  return nullptr;
}

// "NV097_SET_COMBINER_COLOR_ICW" and the bytes behind its first number, as xemu has them.
std::pair<std::string, std::uint32_t> name_and_offset(std::uint32_t method) {
  const Row* const row = row_of(method);
  return row == nullptr ? std::pair{std::string("?"), 0U} : std::pair{std::string(row->method), method - row->number};
}

// With an index that counts elements.
std::string indexed(std::uint32_t method, bool envytools) {
  const Row* const row = row_of(method);
  if (row == nullptr) return envytools ? format("0x%x", method) : format("NV097_UNKNOWN_%04X", method);
  std::string name = envytools ? row->word : row->method;
  if (row->count > 1) name += format(envytools ? "[0x%x]" : "[%u]", (method - row->number) / 4);
  return name;
}

std::string lines(const Trace& trace, const std::function<std::string(const TraceWrite&)>& line) {
  std::string text;
  for (const TraceWrite& write : trace) text += line(write) + '\n';
  return text;
}

std::string xemu(const Trace& trace, const char* before) {
  return lines(trace, [&](const TraceWrite& w) {
    const auto [name, offset] = name_and_offset(w.method);
    return before + format("nv2a_pgraph_method 0: 0x%x -> 0x%04x %s[%u] 0x%x", w.object_class, w.method, name.c_str(),
                           offset, w.data);
  });
}

std::string nvtrc(const Trace& trace) {
  return "pgraph method log from nvtrc\n" + lines(trace, [](const TraceWrite& w) {
           return format("nv2a_pgraph_method 0: 0x%x -> 0x%x 0x%x", w.object_class, w.method, w.data) +
                  format("\n  Detailed info:\n    Address: 0x%x\n    Method: 0x%x\n    Param[1]: 0x%x\n", 0x3f40U,
                         w.method, w.data);
         });
}

std::string pretty(const Trace& trace) {
  return lines(trace, [](const TraceWrite& w) {
    const auto [name, offset] = name_and_offset(w.method);
    return format("nv2a_pgraph_method 0: NV20_KELVIN_PRIMITIVE<0x%x> -> %s<0x%X> (0x%X {[A: Zero], 0x12})",
                  w.object_class, name.c_str(), w.method, w.data);
  });
}

std::string xqemu(const Trace& trace) {
  return lines(trace, [](const TraceWrite& w) {
    return format("nv2a: pgraph method (%d): 0x%x -> 0x%04x (0x%x)", 0, w.object_class, w.method, w.data);
  });
}

std::string commands(const Trace& trace) {
  return "<frame>\n" +
         lines(trace,
               [](const TraceWrite& w) {
                 return format(
                     "        <command op=\"0x%x\" channel=\"0\" class=\"0x%x\" class_name=\"X\" name=\"?[0]\" "
                     "value=\"0x%x\" value_info=\"0x7\" />",
                     w.method, w.object_class, w.data);
               }) +
         "</frame>\n";
}

std::string demmt(const Trace& trace) {
  return lines(trace, [](const TraceWrite& w) {
    const char* const object = w.object_class == 0x97 ? "NV20_3D" : "NV03_M2MF";
    return format("PB: 0x%08x   size 1, subchannel 0 (class: 0x0097, handle: 0xbeef0097), offset 0x%04x, increment\n",
                  1U, w.method) +
           format("PB: 0x%08x   %s.%s = { 0x1 | ZERO }", w.data, object, indexed(w.method, true).c_str());
  });
}

std::string table(const Trace& trace, const char* header, const char* how) {
  return header + lines(trace, [&](const TraceWrite& w) { return format(how, w.object_class, w.method, w.data); });
}

// The tracer's page: an address, the method, the data also as a number.
std::string page(const Trace& trace) {
  return "<html><head><style>td { padding: 10px }</style></head><body><table>\n" +
         lines(trace, [](const TraceWrite& w) {
           return format("<tr><td></td><td>0x%08X</td><td>0x%04X</td><td>0x%08X / %f</td></tr>", 0x80012340U, w.method,
                         w.data, 1.5);
         });
}

}  // namespace

std::vector<TraceStyle> all_styles() {
  return {
      {"xemu", false, true, [](const Trace& t) { return xemu(t, ""); }},
      {"xemu with times", false, true, [](const Trace& t) { return xemu(t, "4242@1700000000.123456:"); }},
      {"nvtrc, verbose", false, true, nvtrc},
      {"nv2apretty", false, true, pretty},
      {"xqemu", false, true, xqemu},
      {"commands", false, true, commands},
      {"demmt", false, true, demmt},
      {"CSV", false, true, [](const Trace& t) { return table(t, "class,method,data\n", "0x%x,0x%x,0x%08x"); }},
      {"CSV of other names and bare digits", false, true,
       [](const Trace& t) { return table(t, "# a trace\nobject;addr;value\n", "%02x;%04X;%08X"); }},
      {"TSV with times", false, true,
       [](const Trace& t) { return table(t, "time\tclass\toffset\tparam\n", "1.5\t0x%x\t0x%04x\t0x%x"); }},
      {"quoted CSV in decimal", false, true,
       [](const Trace& t) {
         return "\"index\",\"method\",\"data\",\"class\"\n" + lines(t, [](const TraceWrite& w) {
                  return format("\"7\",\"%u\",\"%u\",\"0x%x\"", w.method, w.data, w.object_class);
                });
       }},
      {"blanks under a header", false, true,
       [](const Trace& t) { return table(t, "class  mthd    data\n", "0x%x   0x%04x  0x%x"); }},
      {"names under a header", false, false,
       [](const Trace& t) {
         return "method,data\r\n" +
                lines(t, [](const TraceWrite& w) { return indexed(w.method, false) + format(",0x%x\r", w.data); });
       }},
      {"two columns", true, false,
       [](const Trace& t) {
         return lines(t, [](const TraceWrite& w) { return format("0x%04x 0x%08x", w.method, w.data); });
       }},
      {"bare columns", true, false,
       [](const Trace& t) {
         return lines(t, [](const TraceWrite& w) { return format("%04x: %08x", w.method, w.data); });
       }},
      {"class, method, data", true, true,
       [](const Trace& t) { return table(t, "", "[12.5] subch 0 cls 0x%x mthd 0x%x data 0x%x"); }},
      {"names in text", true, false,
       [](const Trace& t) {
         return lines(t, [](const TraceWrite& w) {
           return format("write %s", indexed(w.method, false).c_str()) + format(" <- 0x%x", w.data);
         });
       }},
      {"data first", true, false,
       [](const Trace& t) {
         return lines(t, [](const TraceWrite& w) { return format("push 0x%08x to 0x%04x", w.data, w.method); });
       }},
      {"a page", true, false, page},
  };
}

std::uint32_t method_of_word(const std::string& name) {
  for (const Row& row : kRows) {
    const std::string word = row.word;
    if (name == word) return row.number;
    if (row.count > 1 && name.starts_with(word + "[")) {
      return row.number + 4 * static_cast<std::uint32_t>(name[word.size() + 1] - '0');
    }
  }
  return 0;
}

Trace writes_of(const std::vector<RegisterWord>& words, Random& random) {
  Trace trace;
  for (const RegisterWord& word : words) trace.push_back({method_of_word(word.name), word.value});
  for (std::size_t i = trace.size(); i > 1; --i)
    std::swap(trace[i - 1], trace[static_cast<std::size_t>(random.below(static_cast<int>(i)))]);
  return trace;
}

Trace random_trace(Random& random) {
  Trace trace;
  for (int program = 1 + random.below(3); program > 0; --program) {
    const auto words = encode_register_words(random_state(random, profiles::nv2a), ChipClass::nv20, profiles::nv2a);
    const Trace writes = writes_of(*words, random);
    trace.insert(trace.end(), writes.begin(), writes.end());
    for (int draw = random.below(3); draw > 0; --draw)
      add_draw(trace, 1 + static_cast<std::uint32_t>(random.below(10)));
    if (random.one_in(2)) trace.push_back({0x130, 0});
  }
  return trace;
}

void add_draw(Trace& trace, std::uint32_t primitive, const Trace& inside) {
  trace.push_back({0x17fc, primitive});
  trace.insert(trace.end(), inside.begin(), inside.end());
  trace.push_back({0x17fc, 0});
}

}  // namespace ninebit::test
