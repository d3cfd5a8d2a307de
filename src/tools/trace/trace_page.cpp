#include "src/tools/trace/trace_page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <utility>

#include "ninebit/language/explain.h"
#include "src/system/lines.h"
#include "src/tools/common/explanation.h"
#include "src/tools/input/host.h"
#include "src/tools/input/printable.h"
#include "src/tools/trace/trace_pixel.h"

namespace ninebit::tools {
namespace {

// The trace of one fragment, and its program's equations.
Json page_trace(const TraceFacts& facts, const TracedPixel* pixel, const Program& program,
                const RegisterFile& registers) {
  const TraceHeading heading{
      .profile = facts.profile, .program = facts.program, .pixel = pixel, .stages = facts.stages};
  const Trace traced = trace(program, *facts.hardware, registers);
  return {{"trace", trace_answer(heading, &program, &traced)},
          {"explanation", explanation_json(explain(program, *facts.hardware), TextProgram{}, facts.profile)}};
}

// The page's text about a pass beside its diagram.
Json pass_notes(const TracedPixel& pixel, const ProbedPass& pass, const Program* program) {
  Json notes = Json::array();
  if (program == nullptr) notes.push_back("No program: the combiners are off, and the primary colour is drawn.");
  for (const ProbedFragment& fragment : pass.fragments) {
    const bool decided = &fragment == deciding_fragment(pass) && program != nullptr;
    notes.push_back(fmt::format("{}: {}; colour {}", decided ? "Traced fragment" : "Fragment",
                                fragment_text(pixel, fragment), fmt::join(fragment.color, ", ")));
  }
  return notes;
}

// The lines of a text, without the blanks before them.
Json lines_of(std::string_view text) {
  Json lines = Json::array();
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    lines.push_back(trimmed(text.substr(0, end)));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

Json drawn_passes(const TraceFacts& facts) {
  TracedPixel pixel = *facts.pixel;
  Json passes = Json::array();
  std::size_t first = 0;
  for (std::size_t i = 0; i < pixel.passes.size(); ++i) {
    const ProbedPass& pass = pixel.passes[i];
    if (pass.fragments.empty()) continue;
    // A program that is given replaces those of passes; if no pass has one, it is traced in all of them.
    const bool traced = pass.program || (facts.given != nullptr && facts.pixel->pass == i);
    const Program* const program = !traced ? nullptr : facts.given != nullptr ? facts.given : &*pass.program;
    if (facts.pixel->pass == i) first = passes.size();
    Json shown = Json::object();
    const bool chosen = choose_pass(pixel, i);
    if (program != nullptr && chosen) {
      shown = page_trace(facts, &pixel, *program, pass.fragments[*pixel.fragment].registers);
    }
    shown["name"] = printable(pass.name);
    shown["notes"] = pass_notes(*facts.pixel, pass, program);
    passes.push_back(std::move(shown));
  }
  return passes.empty() ? Json() : Json{{"first", first}, {"passes", std::move(passes)}};
}

}  // namespace

std::string facts_text(const TraceFacts& facts, const Program* program, const Trace* traced, TraceLayout layout) {
  std::string lines = facts.pixel != nullptr ? pixel_text(*facts.pixel) : "";
  if (facts.truth != nullptr) lines += truth_text(*facts.pixel, *facts.truth);
  if (traced != nullptr) {
    if (!facts.program.empty()) lines += fmt::format("program {}, ", printable(facts.program));
    lines += fmt::format("profile {}\n", printable(facts.profile));
  }
  if (facts.stages != nullptr) lines += stages_text(*facts.stages);
  lines = wrapped(printable_lines(lines), layout.columns);
  // The trace itself contains no foreign names, but may contain colour escapes.
  return traced != nullptr ? lines + trace_text(*program, *traced, layout) : lines;
}

Result<std::vector<std::string>> judged_pixel_texts(const SceneFlags& flags, const CommonFlags& common,
                                                    const Scene& scene, const RenderSettings& settings,
                                                    const GroundTruthScene& rays, const Progress& progress) {
  std::vector<std::string> texts;
  const auto add_text = [&](const RenderedPixel& one) {
    const TracedPixel& pixel = one.traced;
    const TraceFacts facts{
        .profile = common.profile, .pixel = &pixel, .truth = &*one.truth, .hardware = &settings.profile};
    if (!pixel.fragment) {
      texts.push_back(facts_text(facts, nullptr, nullptr, {}));
      return;
    }
    const ProbedPass& pass = pixel.passes[*pixel.pass];
    const Trace traced = trace(*pass.program, settings.profile, pass.fragments[*pixel.fragment].registers);
    texts.push_back(facts_text(facts, &*pass.program, &traced, {}));
  };
  if (Status rendered = render_pixels(flags, scene, settings, &rays, false, progress, add_text); !rendered) {
    return rendered.error();
  }
  return texts;
}

DiagramPage trace_page(const TraceFacts& facts) {
  DiagramPage page{.kind = "ninebit trace", .title = printable(facts.program)};
  const auto fact = [&](const char* name, const std::string& value) {
    page.facts.emplace_back(name, printable(value));
  };
  if (const TracedPixel* const pixel = facts.pixel) {
    page.title = fmt::format("Pixel {},{} of {}", pixel->x, pixel->y, printable(pixel->file));
    if (!facts.program.empty()) fact("Program", facts.program);
    if (!pixel->technique.empty()) fact("Technique", pixel->technique);
    fact("Size", pixel->size);
    fact("State", pixel->state);
    if (facts.truth != nullptr) {
      constexpr std::string_view kName = "truth: ";  // the fact has one of its own
      const std::string text = truth_text(*pixel, *facts.truth).substr(kName.size());
      fact("Ground truth", fmt::format("{}", fmt::join(lines_of(text).get<std::vector<std::string>>(), "; ")));
    }
    if (pixel->pass) fact("Pass", pixel->passes[*pixel->pass].name);
  }
  fact("Profile", facts.profile);
  Json drawn;
  if (facts.pixel != nullptr) {
    drawn = drawn_passes(facts);
  } else {
    Json only = page_trace(facts, nullptr, *facts.given, facts.registers);
    const auto bytes = only["trace"]["out"]["bytes"].get<std::array<int, 4>>();
    if (facts.stages != nullptr) only["notes"] = lines_of(stages_text(*facts.stages));
    fact("Out", fmt::format("bytes {}", fmt::join(bytes, ", ")));
    drawn = {{"first", 0}, {"passes", Json::array({std::move(only)})}};
  }
  fact("Version", "ninebit " NINEBIT_VERSION);
  if (!given_command().empty()) fact("Command", given_command());
  if (!drawn.is_null()) page.passes = json_text(drawn);
  return page;
}

}  // namespace ninebit::tools
