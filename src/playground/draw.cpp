// Drawing: the picture, one pixel of it, and two profiles beside each other.
#include <algorithm>
#include <cstdlib>
#include <utility>

#include "ninebit/effect/effect_json.h"
#include "ninebit/numerics/profile_fields.h"
#include "src/playground/drawing.h"
#include "src/playground/plane_hash.h"
#include "src/playground/shadow_answer.h"

namespace ninebit::playground {
namespace {

Json pass_names(const Effect& effect) {
  Json names = Json::array();
  for (const EffectPass& pass : effect.passes) names.push_back(pass.name);
  return names;
}

// The difference of two pictures in `bytes`, appended as a grey picture: the largest of a pixel's four components,
// times 16.
Json append_difference(std::vector<std::uint8_t>& bytes, std::size_t each) {
  std::size_t pixels = 0;
  int most = 0;
  bytes.resize(3 * each);
  for (std::size_t i = 0; i < each; i += 4) {
    int largest = 0;
    for (std::size_t c = 0; c < 4; ++c) largest = std::max(largest, std::abs(bytes[i + c] - bytes[each + i + c]));
    pixels += largest != 0 ? 1U : 0U;
    most = std::max(most, largest);
    const auto grey = static_cast<std::uint8_t>(std::min(16 * largest, 255));
    for (std::size_t c = 0; c < 3; ++c) bytes[2 * each + i + c] = grey;
    bytes[2 * each + i + 3] = 255;
  }
  return Json{{"pixels", pixels}, {"max", most}};
}

}  // namespace

RequestedEffect requested_effect(Request& request) {
  RequestedEffect out;
  const std::string text = request.inner("effect");
  out.what.name = request.word_or("name", "effect");
  out.what.files = request.texts("files");
  out.what.choices = request.choices();
  if (request.failed()) {
    out.refused = request.refused();
    return out;
  }
  auto parsed = parse_effect({text, "effect"}, request.moment());
  if (!parsed) {
    out.refused = refusals(parsed.faults(), text);
    return out;
  }
  out.what.effect = std::move(*parsed);
  request.picture_size(out.what.effect.width, out.what.effect.height);
  if (request.failed()) out.refused = request.refused();
  return out;
}

std::optional<Reply> choose_drawn_profile(Request& request, LastDrawing& what) {
  if (request.has("profile") || what.effect.profile.empty()) {
    what.profile = request.profile("profile");
    if (request.failed()) return request.refused();
    return std::nullopt;
  }
  const HardwareProfile* const shipped = find_profile(what.effect.profile);
  if (shipped == nullptr) {
    return refusal("profile " + json::in_quotes(what.effect.profile) + " is unknown; expected one that `about` lists",
                   "effect");
  }
  what.profile.shipped = shipped;
  return std::nullopt;
}

Drawn draw_effect(const LastDrawing& what, const Shelf& shelf, const EffectOptions& options, KeptDrawing& kept) {
  Drawn drawn;
  if (std::string complaint = complaint_about_amount(what.effect, shelf); !complaint.empty()) {
    drawn.refused = refusal(std::move(complaint), "effect");
    return drawn;
  }
  ShelfReaders shelf_readers(what, shelf);
  shelf_readers.reuse(std::exchange(kept.textures, {}));
  if (!kept.profile.is_same(what.profile)) {
    // The renderer's profile has views into the text of the kept one, so an equal profile does not replace it.
    kept.renderer.reset();
    kept.profile = what.profile;
  }
  Status prepared;
  if (kept.renderer) {
    prepared = kept.renderer->change(what.effect, shelf_readers.readers());
    kept.renderer->set_options(options);
  } else {
    auto made = EffectRenderer::make(what.effect, kept.profile.profile(), shelf_readers.readers(), options);
    if (made) kept.renderer.emplace(std::move(*made));
    if (!made) prepared = made.error();
  }
  const Status done = prepared ? kept.renderer->draw() : prepared;
  kept.textures = std::move(shelf_readers).textures();
  if (!done) {
    kept.renderer.reset();
    const bool in_program = !prepared && !shelf_readers.program_faults().empty();
    drawn.refused = in_program ? Reply(shelf_readers.program_faults()) : refusal(done.error());
    return drawn;
  }
  for (const std::string& note : kept.renderer->scene().notes) {
    drawn.warnings.push_back(what.effect.scene.mesh + ": ignored: " + note);
  }
  for (const auto* more : {&shelf_readers.warnings(), &kept.renderer->warnings()}) {
    drawn.warnings.insert(drawn.warnings.end(), more->begin(), more->end());
  }
  return drawn;
}

const Program* Probed::program() const {
  return pixel && pixel->fragment ? &*pixel->passes[*pixel->pass].program : nullptr;
}

const RegisterFile* Probed::registers() const {
  return pixel && pixel->fragment ? &pixel->passes[*pixel->pass].fragments[*pixel->fragment].registers : nullptr;
}

Probed probe_pixel(const LastDrawing& what, const Shelf& shelf, glm::ivec2 from_top, std::string_view pass,
                   KeptDrawing& kept) {
  Probed out;
  const glm::ivec2 from_below(from_top.x, what.effect.height - 1 - from_top.y);
  out.refused = draw_effect(what, shelf, {.layers = false, .pixel = from_below}, kept).refused;
  if (out.refused) return out;
  TracedPixel pixel = pixel_of_effect(what.effect, *kept.renderer, from_top.x, from_top.y, what.name);
  if (!pass.empty()) {
    const auto found =
        std::find_if(pixel.passes.begin(), pixel.passes.end(), [&](const ProbedPass& one) { return one.name == pass; });
    if (found == pixel.passes.end()) {
      out.refused = refusal("no pass " + json::in_quotes(pass) + " drew into the picture");
      return out;
    }
    const bool decided = choose_pass(pixel, static_cast<std::size_t>(found - pixel.passes.begin()));
    if (!decided || !found->program) {
      pixel.pass.reset();
      pixel.fragment.reset();
    }
  }
  out.pixel = std::move(pixel);
  return out;
}

void append_picture(const Surface& surface, std::vector<std::uint8_t>& bytes) {
  const auto width = static_cast<std::size_t>(surface.width()), height = static_cast<std::size_t>(surface.height());
  const std::size_t first = bytes.size();
  bytes.resize(first + width * height * 4);
  for (std::size_t c = 0; c < 4; ++c) {
    const auto& plane = surface.color(static_cast<int>(c));
    for (std::size_t y = 0; y < height; ++y) {
      std::uint8_t* to = bytes.data() + first + 4 * y * width + c;
      const std::uint8_t* from = plane.data() + (height - 1 - y) * width;
      for (std::size_t x = 0; x < width; ++x) to[4 * x] = from[x];
    }
  }
}

Json hashes_of(const Surface& surface) {
  PlaneHash color, stencil;
  for (int c = 0; c < 4; ++c) color.add({surface.color(c).data(), surface.color(c).size()});
  Json hashes{{"color", color.finish()}};
  if (surface.stencil().empty()) return hashes;
  stencil.add({surface.stencil().data(), surface.stencil().size()});
  hashes["stencil"] = stencil.finish();
  return hashes;
}

Reply Engine::draw(Request& request) {
  request.allow({"effect", "files", "choices", "profile", "size", "name", "time", "frame", "hash"});
  RequestedEffect asked = requested_effect(request);
  if (asked.refused) return *asked.refused;
  const bool hashed = request.flag_or("hash", true);
  if (request.failed()) return request.refused();
  if (auto refused = choose_drawn_profile(request, asked.what)) return *refused;
  const Drawn drawn = draw_effect(asked.what, shelf_, {}, kept_);
  if (drawn.refused) return *drawn.refused;
  const Surface& picture = kept_.renderer->picture();
  append_picture(picture, bytes_);
  Json out{{"width", picture.width()}, {"height", picture.height()}};
  out["profile"] = asked.what.profile.profile().name;
  out["passes"] = pass_names(asked.what.effect);
  out["view"] = view_of(kept_.renderer->scene());
  out["moves"] = asked.what.effect.moves;
  out["warnings"] = drawn.warnings;
  if (hashed) out["hash"] = hashes_of(picture);
  out["bytes"] = bytes_.size();
  last_ = std::move(asked.what);
  return out;
}

Reply Engine::pixel(Request& request) {
  request.allow({"x", "y", "pass"});
  if (!last_) return refusal("nothing was drawn yet");
  const Effect& effect = last_->effect;
  const int x = request.number("x", 0, effect.width - 1), y = request.number("y", 0, effect.height - 1);
  const std::string wanted = request.word_or("pass", "");
  if (request.failed()) return request.refused();
  const Probed probed = probe_pixel(*last_, shelf_, {x, y}, wanted, kept_);
  if (!probed.pixel) return *probed.refused;
  const HardwareProfile& profile = last_->profile.profile();
  const TraceHeading heading{.profile = std::string(profile.name), .program = {}, .pixel = &*probed.pixel};
  if (probed.program() == nullptr) return trace_answer(heading, nullptr, nullptr);
  const Trace traced = trace(*probed.program(), profile, *probed.registers());
  return trace_answer(heading, probed.program(), &traced);
}

Reply Engine::compare(Request& request) {
  request.allow({"effect", "files", "choices", "profiles", "size", "name", "time", "frame"});
  RequestedEffect asked = requested_effect(request);
  if (asked.refused) return *asked.refused;
  const json::Value* const profiles = request.value("profiles");
  if (profiles != nullptr && (profiles->type != json::Type::array || profiles->children.size() != 2)) {
    request.reader().fault(profiles->offset, "profiles must be an array of two profiles");
  }
  Json names = Json::array();
  Json out;
  for (std::size_t i = 0; i < 2 && !request.failed(); ++i) {
    const json::Value& wanted = profiles->children[i];
    const bool exact = i == 1 && wanted.type == json::Type::string && wanted.text == "arithmetic";
    ChosenProfile& chosen = asked.what.profile;
    if (exact) {
      chosen.own = OwnedProfile{with_exact_combiners(chosen.profile()), chosen.own ? chosen.own->text : nullptr};
    } else {
      chosen = request.profile_in(wanted);
    }
    if (request.failed()) break;
    // The textures are those of the last drawing; its renderer stays.
    KeptDrawing own{.textures = std::exchange(kept_.textures, {})};
    const Drawn drawn = draw_effect(asked.what, shelf_, {}, own);
    kept_.textures = std::move(own.textures);
    if (drawn.refused) return *drawn.refused;
    const Surface& picture = own.renderer->picture();
    append_picture(picture, bytes_);
    names.push_back(exact ? std::string_view(wanted.text) : chosen.profile().name);
    out["width"] = picture.width();
    out["height"] = picture.height();
  }
  if (request.failed()) return request.refused();
  out["profiles"] = std::move(names);
  out["difference"] = append_difference(bytes_, bytes_.size() / 2);
  out["bytes"] = bytes_.size();
  return out;
}

}  // namespace ninebit::playground
