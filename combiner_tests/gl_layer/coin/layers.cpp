// Coin's sorted layers: transparent rectangles that cut each other, blended in the right order pixel by pixel.
// Usage: layers FILE writes the picture as a PPM.
#include <GL/freeglut.h>
#include <Inventor/SbViewportRegion.h>
#include <Inventor/SoDB.h>
#include <Inventor/actions/SoGLRenderAction.h>
#include <Inventor/nodes/SoCoordinate3.h>
#include <Inventor/nodes/SoFaceSet.h>
#include <Inventor/nodes/SoLightModel.h>
#include <Inventor/nodes/SoMaterial.h>
#include <Inventor/nodes/SoOrthographicCamera.h>
#include <Inventor/nodes/SoSeparator.h>

#include <cstdio>
#include <vector>

namespace {

constexpr int kSide = 256;

// A rectangle over the whole picture whose left and right ends have different distances.
SoSeparator* rectangle(const SbColor& color, float left, float right) {
  auto* const separator = new SoSeparator;
  auto* const material = new SoMaterial;
  material->diffuseColor = color;
  material->transparency = 0.5F;
  separator->addChild(material);
  auto* const coordinates = new SoCoordinate3;
  const SbVec3f corners[]{{-1, -1, left}, {1, -1, right}, {1, 1, right}, {-1, 1, left}};
  coordinates->point.setValues(0, 4, corners);
  separator->addChild(coordinates);
  auto* const faces = new SoFaceSet;
  faces->numVertices = 4;
  separator->addChild(faces);
  return separator;
}

}  // namespace

int main(int argc, char** argv) {
  glutInit(&argc, argv);
  if (argc != 2) return 2;
  // With stencil the depth buffer has 24 bits, as those of the time; Mesa offers 32 without.
  glutInitDisplayMode(GLUT_RGBA | GLUT_ALPHA | GLUT_DEPTH | GLUT_STENCIL | GLUT_DOUBLE);
  glutInitWindowSize(kSide, kSide);
  glutCreateWindow("layers");
  SoDB::init();
  auto* const root = new SoSeparator;
  root->ref();
  auto* const camera = new SoOrthographicCamera;
  camera->position = SbVec3f(0, 0, 5);
  camera->nearDistance = 1.0F;
  camera->farDistance = 10.0F;
  camera->height = 2.0F;
  root->addChild(camera);
  auto* const light = new SoLightModel;
  light->model = SoLightModel::BASE_COLOR;
  root->addChild(light);
  root->addChild(rectangle(SbColor(1, 0, 0), -1, 1));
  root->addChild(rectangle(SbColor(0, 1, 0), 1, -1));
  root->addChild(rectangle(SbColor(0, 0, 1), 0.3F, 0.3F));
  SoGLRenderAction action(SbViewportRegion(kSide, kSide));
  action.setTransparencyType(SoGLRenderAction::SORTED_LAYERS_BLEND);
  action.setSortedLayersNumPasses(4);
  glutDisplayFunc([] {});
  glutMainLoopEvent();
  glClearColor(0, 0, 0, 0);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  glEnable(GL_DEPTH_TEST);
  action.apply(root);
  glFinish();
  std::vector<unsigned char> pixels(3 * kSide * kSide);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, kSide, kSide, GL_RGB, GL_UNSIGNED_BYTE, pixels.data());
  std::FILE* const file = std::fopen(argv[1], "wb");
  if (file == nullptr) return 1;
  std::fprintf(file, "P6\n%d %d\n255\n", kSide, kSide);
  std::fwrite(pixels.data(), 1, pixels.size(), file);
  return std::fclose(file) == 0 ? 0 : 1;
}
