#include "src/gl_layer/capture/capture.h"

#include <algorithm>

#include "src/gl_layer/draw/draw_state.h"
#include "src/gl_layer/driver/driver.h"
#include "src/gl_layer/driver/log.h"

namespace ninebit::gl_layer {
namespace {

constexpr std::size_t kBuffers = 8;
constexpr GLfloat kNotDrawn[]{-1.0F, 0.0F, 0.0F, 0.0F};

bool can_capture(const Driver& d) {
  return d.BindFramebuffer != nullptr && d.BlitFramebuffer != nullptr && d.ClearBufferfv != nullptr &&
         d.ColorMaski != nullptr && d.Disablei != nullptr && d.DrawBuffers != nullptr && d.GenFramebuffers != nullptr &&
         d.GenRenderbuffers != nullptr && d.RenderbufferStorage != nullptr && driver_integer(GL_MAX_DRAW_BUFFERS) >= 8;
}

// Copies and clears are cut by the scissor test.
class WithoutScissor {
 public:
  WithoutScissor() : scissor_(found_driver.IsEnabled(GL_SCISSOR_TEST) == GL_TRUE) {
    if (scissor_) found_driver.Disable(GL_SCISSOR_TEST);
  }
  ~WithoutScissor() {
    if (scissor_) found_driver.Enable(GL_SCISSOR_TEST);
  }
  WithoutScissor(const WithoutScissor&) = delete;
  WithoutScissor& operator=(const WithoutScissor&) = delete;

 private:
  bool scissor_;
};

// The active unit's texture, and the buffer that texels come from, restored at the end.
class SavedTexture {
 public:
  SavedTexture()
      : bound_(driver_integer(GL_TEXTURE_BINDING_2D)), buffer_(driver_integer(GL_PIXEL_UNPACK_BUFFER_BINDING)) {
    if (buffer_ != 0) found_driver.BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  }
  ~SavedTexture() {
    if (buffer_ != 0) found_driver.BindBuffer(GL_PIXEL_UNPACK_BUFFER, static_cast<GLuint>(buffer_));
    found_driver.BindTexture(GL_TEXTURE_2D, static_cast<GLuint>(bound_));
  }
  SavedTexture(const SavedTexture&) = delete;
  SavedTexture& operator=(const SavedTexture&) = delete;

 private:
  GLint bound_, buffer_;
};

// The program's state of pixel transfers to memory, restored at the end.
class PlainReads {
 public:
  PlainReads() : buffer_(driver_integer(GL_PIXEL_PACK_BUFFER_BINDING)) {
    found_driver.PushClientAttrib(GL_CLIENT_PIXEL_STORE_BIT);
    for (const GLenum name :
         std::to_array<GLenum>({GL_PACK_ROW_LENGTH, GL_PACK_SKIP_ROWS, GL_PACK_SKIP_PIXELS, GL_PACK_SWAP_BYTES})) {
      found_driver.PixelStorei(name, 0);
    }
    found_driver.PixelStorei(GL_PACK_ALIGNMENT, 4);
    if (buffer_ != 0) found_driver.BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  }
  ~PlainReads() {
    if (buffer_ != 0) found_driver.BindBuffer(GL_PIXEL_PACK_BUFFER, static_cast<GLuint>(buffer_));
    found_driver.PopClientAttrib();
  }
  PlainReads(const PlainReads&) = delete;
  PlainReads& operator=(const PlainReads&) = delete;

 private:
  GLint buffer_;
};

}  // namespace

bool draws_anything(const CapturedDraw& draw) {
  return std::any_of(draw.primary.begin(), draw.primary.end(), [](const FloatPixel& p) { return p[0] >= 0.0F; });
}

std::unique_ptr<Capture> Capture::begin(Context& context, const char* call) {
  const Driver& d = found_driver;
  if (context.program == nullptr || !context.bound) return nullptr;
  if (context.inputs.environments) return nullptr;  // no combiners
  if (!can_capture(d)) {
    log_once("the driver has no framebuffer objects with eight buffers: draw calls are not captured");
    return nullptr;
  }
  std::unique_ptr<Capture> capture(new Capture(context));
  GLint viewport[4]{};
  d.GetIntegerv(GL_VIEWPORT, viewport);
  CapturedDraw& draw = capture->draw_;
  draw.call = call;
  draw.width = std::clamp(viewport[0] + viewport[2], 0, 16384);
  draw.height = std::clamp(viewport[1] + viewport[3], 0, 16384);
  draw.inputs = context.inputs;
  draw.program = context.program->number;
  if (draw.width == 0 || draw.height == 0 || !capture->make_buffers()) return nullptr;
  if (const GLenum error = d.GetError(); error != GL_NO_ERROR) context.raise(error);  // the program's own
  capture->copy_in();
  d.BindFramebuffer(GL_DRAW_FRAMEBUFFER, capture->own_framebuffer_);
  capture->set_up_buffers();
  // The same program with another end, which counts as the same.
  const CachedProgram& drawn_with = *context.program;
  context.inputs.write_inputs = context.program_stale = true;
  context.inputs_stale = false;
  prepare_draw(context);
  if (context.program == nullptr || !context.bound) return nullptr;
  context.program->number = drawn_with.number;
  context.program->draws = drawn_with.draws;
  return capture;
}

bool Capture::make_buffers() {
  const Driver& d = found_driver;
  program_framebuffer_ = static_cast<GLuint>(driver_integer(GL_DRAW_FRAMEBUFFER_BINDING));
  read_framebuffer_ = driver_integer(GL_READ_FRAMEBUFFER_BINDING);
  const GLint renderbuffer = driver_integer(GL_RENDERBUFFER_BINDING);
  const SavedTexture kept;
  d.GenFramebuffers(1, &own_framebuffer_);
  d.BindFramebuffer(GL_DRAW_FRAMEBUFFER, own_framebuffer_);
  d.GenTextures(static_cast<GLsizei>(kBuffers), textures_.data());
  for (std::size_t i = 0; i < kBuffers; ++i) {
    d.BindTexture(GL_TEXTURE_2D, textures_[i]);
    d.TexImage2D(GL_TEXTURE_2D, 0, i == 0 ? GL_RGBA8 : GL_RGBA32F, draw_.width, draw_.height, 0, GL_RGBA, GL_FLOAT,
                 nullptr);
    d.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    d.FramebufferTexture2D(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(i), GL_TEXTURE_2D,
                           textures_[i], 0);
  }
  d.GenRenderbuffers(1, &depth_buffer_);
  d.BindRenderbuffer(GL_RENDERBUFFER, depth_buffer_);
  d.RenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH24_STENCIL8, draw_.width, draw_.height);
  d.FramebufferRenderbuffer(GL_DRAW_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_RENDERBUFFER, depth_buffer_);
  const bool complete = d.CheckFramebufferStatus(GL_DRAW_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  d.BindRenderbuffer(GL_RENDERBUFFER, static_cast<GLuint>(renderbuffer));
  d.BindFramebuffer(GL_DRAW_FRAMEBUFFER, program_framebuffer_);
  if (!complete) log_once("the driver draws not into eight buffers of this kind: draw calls are not captured");
  return complete;
}

// The state of the colour buffer is the program's; the inputs are neither blended nor masked.
void Capture::set_up_buffers() {
  const Driver& d = found_driver;
  std::array<GLenum, kBuffers> buffers{};
  for (std::size_t i = 0; i < kBuffers; ++i) buffers[i] = GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(i);
  d.DrawBuffers(static_cast<GLsizei>(kBuffers), buffers.data());
  d.GetBooleanv(GL_COLOR_WRITEMASK, color_mask_.data());
  const WithoutScissor whole;
  for (GLuint i = 1; i < kBuffers; ++i) {
    d.ColorMaski(i, GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    d.Disablei(GL_BLEND, i);
    d.ClearBufferfv(GL_COLOR, static_cast<GLint>(i), kNotDrawn);
  }
}

void Capture::copy_in() {
  const Driver& d = found_driver;
  const GLint drawn = driver_integer(GL_DRAW_BUFFER);
  d.BindFramebuffer(GL_READ_FRAMEBUFFER, program_framebuffer_);
  const GLint read = driver_integer(GL_READ_BUFFER);
  if (drawn != GL_NONE) d.ReadBuffer(static_cast<GLenum>(drawn));
  d.BindFramebuffer(GL_DRAW_FRAMEBUFFER, own_framebuffer_);
  blit();
  d.ReadBuffer(static_cast<GLenum>(read));
}

void Capture::copy_out() {
  found_driver.BindFramebuffer(GL_READ_FRAMEBUFFER, own_framebuffer_);
  found_driver.ReadBuffer(GL_COLOR_ATTACHMENT0);
  found_driver.BindFramebuffer(GL_DRAW_FRAMEBUFFER, program_framebuffer_);
  blit();
}

// Colour, depth and stencil.
void Capture::blit() const {
  const WithoutScissor whole;
  const int w = draw_.width, h = draw_.height;
  found_driver.BlitFramebuffer(0, 0, w, h, 0, 0, w, h, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  found_driver.BlitFramebuffer(0, 0, w, h, 0, 0, w, h, GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT, GL_NEAREST);
  if (found_driver.GetError() != GL_NO_ERROR) {
    log_once(
        "this framebuffer has no depth of 24 bits and stencil of 8: captured draw calls are not tested against it");
  }
}

std::vector<FloatPixel> Capture::read_floats(std::size_t buffer) const {
  std::vector<FloatPixel> pixels(static_cast<std::size_t>(draw_.width) * static_cast<std::size_t>(draw_.height));
  found_driver.ReadBuffer(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(buffer));
  found_driver.ReadPixels(0, 0, draw_.width, draw_.height, GL_RGBA, GL_FLOAT, pixels.data());
  return pixels;
}

CapturedDraw Capture::end() {
  const Driver& d = found_driver;
  const PlainReads plain;
  d.BindFramebuffer(GL_READ_FRAMEBUFFER, own_framebuffer_);
  draw_.primary = read_floats(1);
  draw_.secondary = read_floats(2);
  draw_.fog = read_floats(3);
  for (std::size_t i = 0; i < kLayerUnits; ++i) {
    if (draw_.inputs.stages || draw_.inputs.units[i].target != StageTarget::none) draw_.texels[i] = read_floats(4 + i);
  }
  d.ReadBuffer(GL_COLOR_ATTACHMENT0);
  draw_.color.resize(draw_.primary.size());
  d.ReadPixels(0, 0, draw_.width, draw_.height, GL_RGBA, GL_UNSIGNED_BYTE, draw_.color.data());
  // The first buffer has the program's blending and mask: now all have them again.
  d.IsEnabled(GL_BLEND) == GL_TRUE ? d.Enable(GL_BLEND) : d.Disable(GL_BLEND);
  d.ColorMask(color_mask_[0], color_mask_[1], color_mask_[2], color_mask_[3]);
  copy_out();
  d.BindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(read_framebuffer_));
  context_.inputs.write_inputs = false;
  context_.program_stale = true;
  return std::move(draw_);
}

Capture::~Capture() {
  const Driver& d = found_driver;
  if (own_framebuffer_ != 0) d.DeleteFramebuffers(1, &own_framebuffer_);
  if (depth_buffer_ != 0) d.DeleteRenderbuffers(1, &depth_buffer_);
  if (textures_[0] != 0) d.DeleteTextures(static_cast<GLsizei>(kBuffers), textures_.data());
}

}  // namespace ninebit::gl_layer
