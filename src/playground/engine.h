// The engine of the playground: requests as JSON, answers as JSON, pictures as bytes. docs/playground_engine.md lists
// both.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/effect/effect.h"
#include "ninebit/effect/effect_renderer.h"
#include "src/playground/request.h"

namespace ninebit::playground {

// The longest request, and the largest put, in bytes.
inline constexpr std::size_t kMaxRequestBytes = std::size_t{16} << 20;
inline constexpr std::size_t kMaxPutBytes = std::size_t{64} << 20;
// The most that is kept of what was put, in bytes.
inline constexpr std::size_t kMaxKeptBytes = std::size_t{256} << 20;
// The largest width and height of a picture that is drawn or put.
inline constexpr int kMaxDrawnSide = 4096;

// A picture that was put: RGBA, rows from the top.
struct PutPixels {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba{};
};

// The files that an effect names.
struct Shelf {
  std::map<std::string, PutPixels, std::less<>> pixels{};
  std::map<std::string, std::vector<std::uint8_t>, std::less<>> files{};
};

// Textures of the last drawing, for the next one, with the warnings that came with them.
struct CachedTexture {
  TextureRecipe recipe{};
  Texture texture{};
  std::vector<std::string> warnings{};
};

// What the last "draw" leaves for the next one, and for what is asked about it.
struct KeptDrawing {
  std::vector<CachedTexture> textures{};
  std::optional<EffectRenderer> renderer{};  // of `profile`
  ChosenProfile profile{};
};

// The last drawing, for "pixel".
struct LastDrawing {
  std::string name{};        // of the effect
  Effect effect{};           // with the size of the request
  ChosenProfile profile{};   // that it was drawn with
  FileTexts files{};         // the texts of the request
  ProgramChoices choices{};  // how they are read
};

class Judging;

// Answers one request after the other. It keeps what is put, the last drawing and the shadows that are being judged;
// nothing else that is asked changes an answer. The same requests give the same answers, byte for byte, on every
// machine.
class Engine {
 public:
  Engine();
  ~Engine();
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  // One JSON object. A request that is not one, or asks for something that is not there, is answered by a fault.
  [[nodiscard]] std::string answer(std::string_view request);
  // Memory for the next "put". Its content is that of the last call, cut or extended by zeros; more than kMaxPutBytes
  // gives none.
  [[nodiscard]] std::span<std::uint8_t> buffer(std::size_t bytes);
  // The binary part of the last answer, as many bytes as its "bytes" says; empty: it has none.
  [[nodiscard]] std::span<const std::uint8_t> bytes() const { return bytes_; }

 private:
  Reply reply_to(Request& request, std::string_view verb);
  Reply put(Request& request);
  Reply draw(Request& request);
  Reply pixel(Request& request);
  Reply compare(Request& request);
  Reply combiners(Request& request);
  Reply sweep(Request& request);
  Reply losses(Request& request);
  Reply room(Request& request);
  Reply judge(Request& request);
  Reply judge_rows(Request& request);

  Shelf shelf_{};
  std::vector<std::uint8_t> buffer_{};
  std::vector<std::uint8_t> bytes_{};
  std::optional<LastDrawing> last_{};
  KeptDrawing kept_{};  // nothing after a "put"
  std::unique_ptr<Judging> judging_;
};

}  // namespace ninebit::playground
