// A node of a scene graph that blends layers: the functions of OpenGL are members of an object of the context.
#include "LayerBlend.h"

using namespace graph;

class LayerBlend : public Node {
 public:
  enum Order { FRONT_TO_BACK, BACK_TO_FRONT };
  void apply(GLContext* ctx, Order order, bool invert = false);

 private:
  bool prepare(GLContext* ctx);
  GLenum unit;
};

bool LayerBlend::prepare(GLContext* ctx) {
  if (!ctx->has_nv_register_combiners) return false;
  assert(ctx->glCombinerInputNV != NULL && "checked above");

  // !!RC1.0
  // { rgb { spare0 = unsigned_invert(tex3) * col0.a; } }
  ctx->glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 1);
  ctx->glCombinerInputNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_A_NV, GL_TEXTURE3, GL_UNSIGNED_INVERT_NV, GL_RGB);
  ctx->glCombinerInputNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_B_NV, GL_PRIMARY_COLOR_NV, GL_SIGNED_IDENTITY_NV,
                         GL_ALPHA);
  ctx->glCombinerOutputNV(GL_COMBINER0_NV, GL_RGB, GL_SPARE0_NV, GL_DISCARD_NV, GL_DISCARD_NV, GL_ZERO, GL_ZERO,
                          GL_FALSE, GL_FALSE, GL_FALSE);
  if (glGetError() != GL_NO_ERROR) {
    report("cannot set up the combiners");
    return false;
  }
  return true;
}

void LayerBlend::apply(GLContext* ctx, Order order, bool invert) {
  if (!this->prepare(ctx)) return;
  const GLenum mapping = invert ? GL_UNSIGNED_INVERT_NV : GL_UNSIGNED_IDENTITY_NV;

  switch (order) {
    case FRONT_TO_BACK:
      ctx->glFinalCombinerInputNV(GL_VARIABLE_D_NV, GL_SPARE0_NV, mapping, GL_RGB);
      break;
    case BACK_TO_FRONT:
      ctx->glFinalCombinerInputNV(GL_VARIABLE_D_NV, this->unit, mapping, GL_RGB);
      break;
    default:
      assert(0 && "unknown order");
      break;
  }
  glEnable(GL_REGISTER_COMBINERS_NV);
}
