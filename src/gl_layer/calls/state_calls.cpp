// glEnable and its like, errors, and the attribute stack.
#include "src/gl_layer/calls/display_lists.h"
#include "src/gl_layer/calls/paletted_textures.h"
#include "src/gl_layer/context/context.h"
#include "src/gl_layer/draw/vertex_programs.h"
#include "src/gl_layer/driver/driver.h"

using namespace ninebit::gl_layer;  // NOLINT(google-build-using-namespace): these are OpenGL's names
namespace front = ninebit::gl;

namespace {

bool is_the_layers(const Context& context, GLenum cap) {
  const ninebit::HardwareProfile& profile = context.combiners.profile();
  return cap == GL_REGISTER_COMBINERS_NV || (cap == GL_PER_STAGE_CONSTANTS_NV && profile.per_stage_constants) ||
         (cap == GL_TEXTURE_SHADER_NV && profile.texture_shaders);
}

bool is_shared_palette(const Context& context, GLenum cap) {
  return cap == GL_SHARED_TEXTURE_PALETTE_EXT && context.features.extras.have(Extra::shared_texture_palette);
}

bool changes_inputs(GLenum cap) {
  switch (cap) {
    case GL_TEXTURE_1D:
    case GL_TEXTURE_2D:
    case GL_TEXTURE_3D:
    case GL_TEXTURE_CUBE_MAP:
    case GL_TEXTURE_RECTANGLE:
    case GL_COLOR_SUM:
    case GL_LIGHTING:
    case GL_FRAGMENT_PROGRAM_ARB:
    case GL_VERTEX_PROGRAM_ARB:
      return true;
    default:
      return false;
  }
}

void set_enabled(GLenum cap, bool enabled) {
  Context* const context = current();
  const auto by_driver = enabled ? find_driver().Enable : find_driver().Disable;
  if (context == nullptr) return by_driver(cap);
  if (is_shared_palette(*context, cap)) return enable_shared_palette(enabled);
  if (!is_the_layers(*context, cap)) {
    by_driver(cap);
    if (cap == GL_FOG) return mark_fog_stale();
    if (changes_inputs(cap)) mark_stale();
    return;
  }
  context->touched = true;
  if (context->open_list != nullptr) {
    if (context->list_in_begin()) return record_begin_error(*context);
    return record(*context, [cap, enabled] { set_enabled(cap, enabled); });
  }
  if (!context->outside_begin()) return;
  const front::CurrentContext current(context->combiners);
  enabled ? front::glEnable(cap) : front::glDisable(cap);
  context->forget();
}

// The attribute groups in which the layer has state.
constexpr GLbitfield kGroups = GL_ENABLE_BIT | GL_TEXTURE_BIT | GL_PIXEL_MODE_BIT;

int stack_depth() {
  return driver_integer(GL_ATTRIB_STACK_DEPTH);
}

void push(Context& context, GLbitfield mask) {
  const int before = stack_depth();
  found_driver.PushAttrib(mask);
  const int depth = stack_depth();
  if (depth == before || (mask & kGroups) == 0) return;
  SavedState saved{.mask = mask,
                   .depth = depth,
                   .no_environment = context.no_environment,
                   .pixel_transfer = context.pixel_transfer,
                   .shared_palette = context.shared_palette.enabled};
  if (context.touched) saved.combiners = std::make_unique<front::Context>(context.combiners);
  context.attribute_stack.push_back(std::move(saved));
}

void restore(Context& context, const SavedState& saved) {
  if ((saved.mask & GL_PIXEL_MODE_BIT) != 0) context.pixel_transfer = saved.pixel_transfer;
  if ((saved.mask & (GL_ENABLE_BIT | GL_TEXTURE_BIT)) == 0) return;
  if (saved.shared_palette != context.shared_palette.enabled) enable_shared_palette(saved.shared_palette);
  if (!context.touched) return;
  // Saved before the program used combiners: the defaults.
  const front::Context combiners =
      saved.combiners != nullptr ? *saved.combiners : front::Context(context.combiners.profile());
  context.combiners.enable_register_combiners(combiners.register_combiners_enabled());
  context.combiners.texture_shader().enabled = combiners.texture_shader().enabled;
  if ((saved.mask & GL_TEXTURE_BIT) != 0) {
    context.combiners.state() = combiners.state();
    context.combiners.texture_shader() = combiners.texture_shader();
    context.no_environment = saved.no_environment;
  } else {
    context.combiners.state().per_stage_constants = combiners.state().per_stage_constants;
  }
}

void pop(Context& context) {
  const int depth = stack_depth();
  found_driver.PopAttrib();
  auto& stack = context.attribute_stack;
  while (!stack.empty() && stack.back().depth > depth) stack.pop_back();  // popped where the layer did not see it
  if (!stack.empty() && stack.back().depth == depth) {
    restore(context, stack.back());
    stack.pop_back();
  }
  context.forget();
}

}  // namespace

GLAPI void GLAPIENTRY glEnable(GLenum cap) {
  set_enabled(cap, true);
}

GLAPI void GLAPIENTRY glDisable(GLenum cap) {
  set_enabled(cap, false);
}

GLAPI GLboolean GLAPIENTRY glIsEnabled(GLenum cap) {
  Context* const context = current();
  if (context != nullptr && cap == GL_VERTEX_ARRAY_RANGE_NV &&
      context->features.extras.have(Extra::vertex_array_range)) {
    return context->outside_begin() && context->vertex_range.enabled ? GL_TRUE : GL_FALSE;
  }
  if (context != nullptr && is_shared_palette(*context, cap)) {
    return context->outside_begin() && context->shared_palette.enabled ? GL_TRUE : GL_FALSE;
  }
  if (is_attribute_array(context, cap)) {
    const unsigned bit = context->vertex.arrays >> (cap - GL_VERTEX_ATTRIB_ARRAY0_NV) & 1;
    return context->outside_begin() && bit != 0 ? GL_TRUE : GL_FALSE;
  }
  if (context == nullptr || !is_the_layers(*context, cap)) return find_driver().IsEnabled(cap);
  if (!context->outside_begin()) return GL_FALSE;
  const front::CurrentContext current(context->combiners);
  return front::glIsEnabled(cap);
}

GLAPI GLenum GLAPIENTRY glGetError() {
  Context* const context = current();
  if (context == nullptr || context->in_begin || context->pending_error == 0) return find_driver().GetError();
  const GLenum error = context->pending_error;
  context->pending_error = 0;
  // Later errors are not kept. A lost context may have no end of them.
  for (int i = 0; i < 8 && found_driver.GetError() != GL_NO_ERROR; ++i) {
  }
  return error;
}

GLAPI void GLAPIENTRY glPushAttrib(GLbitfield mask) {
  Context* const context = current();
  const bool by_driver = context == nullptr || context->in_begin ||
                         (context->open_list != nullptr && (!context->recording() || context->list_in_begin()));
  if (by_driver) return find_driver().PushAttrib(mask);
  if (context->recording()) return record(*context, [mask] { glPushAttrib(mask); });
  push(*context, mask);
}

GLAPI void GLAPIENTRY glPopAttrib() {
  Context* const context = current();
  const bool by_driver = context == nullptr || context->in_begin ||
                         (context->open_list != nullptr && (!context->recording() || context->list_in_begin()));
  if (by_driver) return find_driver().PopAttrib();
  if (context->recording()) return record(*context, [] { glPopAttrib(); });
  pop(*context);
}
