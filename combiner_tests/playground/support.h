// Asks the engine of the playground, and reads its answers.
#pragma once

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>

#include "src/playground/engine.h"

namespace ninebit::test {

using playground::Engine;
using PageJson = nlohmann::ordered_json;

// The answer to a request.
inline PageJson ask(Engine& engine, const PageJson& request) {
  return PageJson::parse(engine.answer(request.dump(-1, ' ', false, PageJson::error_handler_t::replace)));
}
inline PageJson ask(const PageJson& request) {
  Engine engine;
  return ask(engine, request);
}

// The message of an answer that is a fault; empty if it is none.
inline std::string fault_of_answer(const PageJson& answer) {
  return answer.contains("fault") ? answer["fault"]["message"].get<std::string>() : std::string();
}

// The answer to a request; a fault ends the test.
inline PageJson good(Engine& engine, const PageJson& request) {
  PageJson answer = ask(engine, request);
  if (answer.contains("fault")) throw std::runtime_error(fault_of_answer(answer));
  return answer;
}
inline PageJson good(const PageJson& request) {
  Engine engine;
  return good(engine, request);
}

// Puts a file into the engine.
template <class Bytes>
void put_file(Engine& engine, const std::string& name, const Bytes& content) {
  std::copy(content.begin(), content.end(), engine.buffer(content.size()).begin());
  good(engine, {{"do", "put"}, {"name", name}, {"kind", "file"}});
}

// A program, GL calls: the texel times the primary colour.
inline constexpr std::string_view kTexelTimesColor = R"(glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 1);
glCombinerInputNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_A_NV, GL_TEXTURE0_ARB, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
glCombinerInputNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_B_NV, GL_PRIMARY_COLOR_NV, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
)";

// An effect that draws that program on a checkerboard.
inline PageJson checker_effect() {
  return PageJson::parse(R"({"ninebit": "effect", "version": 1, "size": [32, 16],
    "textures": {"squares": {"source": "checker:8", "filter": "nearest"}},
    "passes": [{"program": "mine.gl", "units": [{"texture": "squares"}], "primary": "constant:1,0.5,0.25"}]})");
}

inline PageJson draw_request() {
  return {{"do", "draw"}, {"effect", checker_effect()}, {"files", {{"mine.gl", kTexelTimesColor}}}};
}

}  // namespace ninebit::test
