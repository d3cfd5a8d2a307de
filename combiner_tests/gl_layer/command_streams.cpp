#include "combiner_tests/gl_layer/command_streams.h"

#include "combiner_tests/gl_layer/combiner_commands.h"

namespace ninebit::test {
namespace {

constexpr GLuint kColorTexture = 1, kOtherTexture = 2, kDepthTexture = 3, kShadowTexture = 4, kVolumeTexture = 5;
constexpr GLuint kMissingTexture = 77;

GLuint green_program = 0;

void image(GLenum target, GLuint texture, GLint internal, GLenum format, std::array<std::uint8_t, 4> texel) {
  glBindTexture(target, texture);
  if (target == GL_TEXTURE_3D) {
    glTexImage3D(target, 0, internal, 1, 1, 1, 0, format, GL_UNSIGNED_BYTE, texel.data());
  } else {
    glTexImage2D(target, 0, internal, 1, 1, 0, format, GL_UNSIGNED_BYTE, texel.data());
  }
  use_nearest(target);
}

StreamCommand command(std::string name, std::function<void()> run, bool in_begin = false) {
  return {std::move(name), std::move(run), in_begin};
}

StreamCommand combiner_command(Random& random) {
  if (!random.one_in(10)) {
    const auto reg = random.pick<GLenum>({GL_PRIMARY_COLOR_NV, GL_SECONDARY_COLOR_NV, GL_FOG, GL_TEXTURE0, GL_TEXTURE0,
                                          GL_TEXTURE1, GL_CONSTANT_COLOR0_NV});
    return command("show register " + std::to_string(reg), [reg] { show_register(reg); });
  }
  const CombinerCommand call = random_command(random, profiles::nv2a, true, 20);
  return command("combiner function " + std::to_string(call.function), [call] { execute(kLayerFunctions, call); });
}

StreamCommand enable_command(Random& random) {
  const auto cap =
      random.pick<GLenum>({GL_REGISTER_COMBINERS_NV, GL_TEXTURE_2D, GL_TEXTURE_2D, GL_TEXTURE_3D, GL_FOG, GL_LIGHTING,
                           GL_TEXTURE_SHADER_NV, GL_PER_STAGE_CONSTANTS_NV, GL_TEXTURE_CUBE_MAP, GL_NO_ERROR + 0x1234});
  if (random.one_in(3)) return command("disable " + std::to_string(cap), [cap] { glDisable(cap); });
  return command("enable " + std::to_string(cap), [cap] { glEnable(cap); });
}

StreamCommand texture_command(Random& random) {
  const auto unit = static_cast<GLenum>(GL_TEXTURE0 + random.below(2));
  const auto mode = random.pick<GLint>({GL_ALPHA, GL_LUMINANCE, GL_INTENSITY});
  const auto operation = random.pick<GLint>({GL_NONE, GL_TEXTURE_2D, GL_TEXTURE_2D, GL_TEXTURE_3D, GL_PASS_THROUGH_NV,
                                             GL_CULL_FRAGMENT_NV, GL_DOT_PRODUCT_NV});
  const auto texture =
      random.pick<GLuint>({kColorTexture, kOtherTexture, kDepthTexture, kShadowTexture, kMissingTexture});
  switch (random.below(6)) {
    case 0:
      return command("active unit", [unit] { glActiveTexture(unit); });
    case 1:
      return command("depth mode", [mode] { glTexParameteri(GL_TEXTURE_2D, GL_DEPTH_TEXTURE_MODE, mode); });
    case 2:
      return command("shader operation " + std::to_string(operation),
                     [operation] { glTexEnvi(GL_TEXTURE_SHADER_NV, GL_SHADER_OPERATION_NV, operation); });
    case 3:
      return command("bind volume", [] { glBindTexture(GL_TEXTURE_3D, kVolumeTexture); });
    default:
      return command("bind " + std::to_string(texture), [texture] { glBindTexture(GL_TEXTURE_2D, texture); });
  }
}

StreamCommand other_command(Random& random) {
  const auto byte = static_cast<GLubyte>(random.byte());
  const auto fog = random.pick<GLint>({GL_LINEAR, GL_EXP, GL_EXP2});
  const auto control = random.pick<GLint>({GL_SINGLE_COLOR, GL_SEPARATE_SPECULAR_COLOR});
  const auto mask = random.pick<GLbitfield>({GL_TEXTURE_BIT, GL_ENABLE_BIT, GL_ALL_ATTRIB_BITS, GL_FOG_BIT});
  const std::array<GLfloat, 4> color{random.real_f(0, 1), 0.5F, random.real_f(0, 1), 1.0F};
  switch (random.below(9)) {
    case 0:
      return command("color", [byte] { glColor4ub(byte, 10, 200, static_cast<GLubyte>(255 - byte)); });
    case 1:
      return command("secondary color", [byte] { glSecondaryColor3ub(byte, 99, 3); });
    case 2:
      return command("fog mode", [fog] { glFogi(GL_FOG_MODE, fog); });
    case 3:
      return command("fog color", [color] { glFogfv(GL_FOG_COLOR, color.data()); });
    case 4:
      return command("color control", [control] { glLightModeli(GL_LIGHT_MODEL_COLOR_CONTROL, control); });
    case 5:
      return command("push " + std::to_string(mask), [mask] { glPushAttrib(mask); });
    case 6:
      return command("pop", [] { glPopAttrib(); });
    case 7:
      return command("program", [on = random.one_in(3)] { glUseProgram(on ? green_program : 0); });
    default:
      return command("constant", [color] { glCombinerParameterfvNV(GL_CONSTANT_COLOR0_NV, color.data()); });
  }
}

void add_draw(Random& random, std::vector<StreamCommand>& stream) {
  const GLint x = random.below(4), y = random.below(4);
  const auto corner = [=](GLint i) {
    const auto at = [](GLint cell, bool far) { return static_cast<GLfloat>(cell + (far ? 1 : 0)) * 0.5F - 1.0F; };
    glMultiTexCoord4f(GL_TEXTURE1, -0.25F + static_cast<GLfloat>(i), 0.5F, 0.25F, 1.0F);
    glVertex2f(at(x, i == 1 || i == 2), at(y, i >= 2));
  };
  switch (random.below(4)) {
    case 0:
      stream.push_back(command("rectangle", [=] {
        glRectf(static_cast<GLfloat>(x) * 0.5F - 1.0F, static_cast<GLfloat>(y) * 0.5F - 1.0F,
                static_cast<GLfloat>(x) * 0.5F - 0.5F, static_cast<GLfloat>(y) * 0.5F - 0.5F);
      }));
      return;
    case 1:
      stream.push_back(command("quads", [corner] {
        glBegin(GL_QUADS);
        for (GLint i = 0; i < 4; ++i) corner(i);
        glEnd();
      }));
      return;
    case 2:
      stream.push_back(command("array", [=] {
        const GLfloat left = static_cast<GLfloat>(x) * 0.5F - 1.0F, low = static_cast<GLfloat>(y) * 0.5F - 1.0F;
        const GLfloat vertices[]{left, low, left + 0.5F, low, left, low + 0.5F};
        glEnableClientState(GL_VERTEX_ARRAY);
        glVertexPointer(2, GL_FLOAT, 0, vertices);
        glDrawArrays(GL_TRIANGLES, 0, 3);
        glDisableClientState(GL_VERTEX_ARRAY);
      }));
      return;
    default:
      // In pieces, with a wrong command between them.
      stream.push_back(command(
          "begin", [] { glBegin(GL_QUADS); }, true));
      for (GLint i = 0; i < 4; ++i)
        stream.push_back(command(
            "vertex", [=] { corner(i); }, true));
      if (random.one_in(3)) {
        StreamCommand wrong = combiner_command(random);
        wrong.in_begin = true;
        stream.insert(stream.end() - random.between(0, 3), wrong);
      }
      stream.push_back(command("end", [] { glEnd(); }));
  }
}

}  // namespace

std::vector<StreamCommand> random_stream(Random& random, int commands) {
  std::vector<StreamCommand> stream;
  while (static_cast<int>(stream.size()) < commands) {
    switch (random.below(8)) {
      case 0:
      case 1:
        add_draw(random, stream);
        break;
      case 2:
        stream.push_back(combiner_command(random));
        break;
      case 3:
      case 4:
        stream.push_back(enable_command(random));
        break;
      case 5:
      case 6:
        stream.push_back(texture_command(random));
        break;
      default:
        stream.push_back(other_command(random));
    }
  }
  return stream;
}

void make_stream_objects() {
  image(GL_TEXTURE_2D, kColorTexture, GL_RGBA8, GL_RGBA, {10, 60, 110, 160});
  image(GL_TEXTURE_2D, kOtherTexture, GL_RGBA8, GL_RGBA, {250, 200, 150, 100});
  image(GL_TEXTURE_2D, kDepthTexture, GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, {77, 0, 0, 0});
  image(GL_TEXTURE_2D, kShadowTexture, GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, {99, 0, 0, 0});
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_R_TO_TEXTURE);
  image(GL_TEXTURE_3D, kVolumeTexture, GL_RGBA8, GL_RGBA, {1, 220, 130, 40});
  glBindTexture(GL_TEXTURE_3D, 0);
  glBindTexture(GL_TEXTURE_2D, 0);
  glEnable(GL_LIGHT0);
  glFogi(GL_FOG_COORDINATE_SOURCE, GL_FOG_COORDINATE);
  glFogCoordf(0.4F);
  glSecondaryColor3ub(50, 100, 150);
  clear_picture();
  green_program = make_green_program();
}

StreamResult stream_result() {
  StreamResult result{read_picture(), read_state(kLayerFunctions, profiles::nv2a), glGetError()};
  for (const int cap : {GL_TEXTURE_SHADER_NV, GL_TEXTURE_2D, GL_TEXTURE_3D, GL_FOG, GL_LIGHTING}) {
    result.state.push_back(glIsEnabled(static_cast<GLenum>(cap)));
  }
  for (const int name : {GL_ACTIVE_TEXTURE, GL_ATTRIB_STACK_DEPTH, GL_FOG_MODE, GL_CURRENT_PROGRAM, GL_LIST_INDEX}) {
    GLfloat value = -1;
    glGetFloatv(static_cast<GLenum>(name), &value);
    result.state.push_back(value);
  }
  GLint operation = -1;
  glGetTexEnviv(GL_TEXTURE_SHADER_NV, GL_SHADER_OPERATION_NV, &operation);
  result.state.push_back(static_cast<GLfloat>(operation));
  return result;
}

}  // namespace ninebit::test
