#include "src/playground/engine.h"

#include <utility>

#include "src/playground/drawing.h"
#include "src/playground/judging.h"
#include "src/playground/shadow_answer.h"
#include "src/playground/texts.h"

namespace ninebit::playground {
namespace {

constexpr std::string_view kVerbs =
    "about, vocabulary, read, convert, trace, evaluate, profile, edit_profile, put, draw, pixel, sweep, losses, "
    "compare, combiners, room, shadow, judge or judge_rows";

}  // namespace

Engine::Engine() = default;
Engine::~Engine() = default;

std::string Engine::answer(std::string_view request) {
  bytes_.clear();
  if (request.size() > kMaxRequestBytes) {
    return text_of(refusal("the request has " + std::to_string(request.size()) + " bytes; at most " +
                               std::to_string(kMaxRequestBytes) + " are read",
                           "request"));
  }
  TextFaults faults("request");
  const auto root = json::read_tree(request, faults);
  if (!root) return text_of(refusals(faults.take(), request));
  Request asked(request, *root, faults);
  if (root->type != json::Type::object) {
    asked.reader().wrong_type(*root, "an object");
    return text_of(asked.refused());
  }
  const std::string verb = asked.word("do");
  if (asked.failed()) return text_of(asked.refused());
  const Reply reply = reply_to(asked, verb);
  if (!reply) bytes_.clear();
  return text_of(reply);
}

Reply Engine::reply_to(Request& request, std::string_view verb) {
  if (verb == "about") return about(request);
  if (verb == "vocabulary") return vocabulary(request);
  if (verb == "read") return read_text(request);
  if (verb == "convert") return convert_text(request);
  if (verb == "trace") return trace_text(request);
  if (verb == "evaluate") return evaluate_pictures(request, std::exchange(buffer_, {}), bytes_);
  if (verb == "profile") return list_profile(request);
  if (verb == "edit_profile") return edit_profile(request);
  if (verb == "put") return put(request);
  if (verb == "draw") return draw(request);
  if (verb == "pixel") return pixel(request);
  if (verb == "compare") return compare(request);
  if (verb == "combiners") return combiners(request);
  if (verb == "sweep") return sweep(request);
  if (verb == "losses") return losses(request);
  if (verb == "room") return room(request);
  if (verb == "shadow") return shadow_answer(request, shelf_, bytes_);
  if (verb == "judge") return judge(request);
  if (verb == "judge_rows") return judge_rows(request);
  request.reader().fault(request.find("do")->offset,
                         json::in_quotes(verb) + " is not a request; expected " + std::string(kVerbs));
  return request.refused();
}

std::span<std::uint8_t> Engine::buffer(std::size_t bytes) {
  buffer_.resize(bytes > kMaxPutBytes ? 0 : bytes);
  return buffer_;
}

Reply Engine::put(Request& request) {
  request.allow({"name", "kind", "width", "height"});
  const std::string name = request.word("name"), kind = request.word("kind");
  const bool pixels = kind == "pixels";
  if (!request.failed() && !pixels && kind != "file") {
    request.reader().fault(request.find("kind")->offset,
                           json::in_quotes(kind) + " is not a kind; expected pixels or file");
  }
  if (!request.failed() && (name.empty() || name.size() > 1024)) {
    request.reader().fault(request.find("name")->offset, "a name has 1 to 1024 bytes");
  }
  PutPixels picture;
  if (pixels) {
    picture.width = request.number("width", 1, kMaxDrawnSide);
    picture.height = request.number("height", 1, kMaxDrawnSide);
  }
  if (request.failed()) return request.refused();
  const std::size_t expected = static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height) * 4;
  if (pixels && expected != buffer_.size()) {
    return refusal("the buffer has " + std::to_string(buffer_.size()) + " bytes; these pixels have " +
                   std::to_string(expected));
  }
  kept_ = {};
  shelf_.pixels.erase(name);
  shelf_.files.erase(name);
  std::size_t kept = buffer_.size();
  for (const auto& [key, put] : shelf_.pixels) kept += put.rgba.size();
  for (const auto& [key, bytes] : shelf_.files) kept += bytes.size();
  if (kept > kMaxKeptBytes) return refusal("more than 256 MiB of files and pictures");
  Json out{{"ok", true}, {"name", name}, {"kept", kept}};
  if (pixels) {
    picture.rgba = std::move(buffer_);
    shelf_.pixels.emplace(name, std::move(picture));
  } else {
    shelf_.files.emplace(name, std::move(buffer_));
  }
  buffer_ = {};
  return out;
}

Reply Engine::room(Request& request) {
  request.allow({});
  if (request.failed()) return request.refused();
  bytes_.assign(kRoomText.begin(), kRoomText.end());
  return Json{{"name", kRoomFile}, {"bytes", bytes_.size()}};
}

Reply Engine::judge(Request& request) {
  judging_.reset();  // its memory may be needed
  std::optional<Reply> refused;
  judging_ = Judging::begin(request, shelf_, refused);
  if (!judging_) return *refused;
  return judging_->progress();
}

Reply Engine::judge_rows(Request& request) {
  request.allow({"rows"});
  const int rows = request.number("rows", 1, kMaxDrawnSide);
  if (request.failed()) return request.refused();
  if (!judging_) return refusal("nothing is being judged");
  Reply reply = judging_->judge(rows, bytes_);
  if (judging_->done()) judging_.reset();
  return reply;
}

}  // namespace ninebit::playground
