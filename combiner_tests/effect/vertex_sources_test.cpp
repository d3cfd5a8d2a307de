// Vectors, colours and fog of vertices against their definitions.
#include "src/effect/vertex_sources.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "src/effect/tangents.h"

namespace ninebit::test {
namespace {

// One triangle in a plane that faces +z, with s to the right and t downwards.
Scene one_triangle() {
  Scene scene;
  scene.materials.emplace_back();
  scene.objects.push_back({"triangle", 0, 1});
  scene.positions = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}};
  scene.normals.assign(3, {0, 0, 1});
  scene.texture_coordinates = {{0, 1}, {1, 1}, {0, 0}};
  scene.triangles.emplace_back(0, 1, 2);
  scene.triangle_object = {0};
  scene.triangle_material = {0};
  scene.cameras.push_back({.position = {0, 0, 5}});
  scene.lights.emplace_back().position = {3, 4, 12};
  return scene;
}

// (s, t, r) of a vertex.
glm::vec3 vector_at(VertexSource source, const Scene& scene, std::size_t v,
                    const std::vector<glm::vec4>* tangents = nullptr) {
  const VertexInputs inputs{.scene = &scene, .tangents = tangents};
  const UnitCoordinates coordinates = unit_coordinates({.source = source}, inputs);
  EXPECT_TRUE(coordinates.q.empty());
  return coordinates.str.at(v);
}

TEST(VertexSources, VectorsOfAPointLight) {
  const Scene scene = one_triangle();
  EXPECT_EQ(vector_at(VertexSource::position, scene, 1), glm::vec3(2, 0, 0));
  EXPECT_EQ(vector_at(VertexSource::from_light, scene, 1), glm::vec3(-1, -4, -12));
  EXPECT_EQ(vector_at(VertexSource::light_vector, scene, 1), glm::vec3(1, 4, 12));
  EXPECT_EQ(vector_at(VertexSource::view_vector, scene, 2), glm::vec3(0, -2, 5));
  EXPECT_EQ(vector_at(VertexSource::normal, scene, 2), glm::vec3(0, 0, 1));
  const glm::vec3 half = glm::normalize(glm::vec3(3, 4, 12) / 13.0F + glm::vec3(0, 0, 1));
  EXPECT_LT(glm::length(vector_at(VertexSource::half_vector, scene, 0) - half), 1e-6F);
  const glm::vec3 view = glm::normalize(glm::vec3(0, -2, 5)), reflected(-view.x, -view.y, view.z);
  EXPECT_LT(glm::length(vector_at(VertexSource::reflection, scene, 2) - reflected), 1e-6F);
}

TEST(VertexSources, VectorsOfADirectionalLight) {
  Scene scene = one_triangle();
  scene.lights[0].kind = LightKind::directional;
  scene.lights[0].direction = {0.6F, 0, -0.8F};
  for (std::size_t v = 0; v < 3; ++v) {
    EXPECT_EQ(vector_at(VertexSource::from_light, scene, v), glm::vec3(0.6F, 0, -0.8F));
    EXPECT_EQ(vector_at(VertexSource::light_vector, scene, v), glm::vec3(-0.6F, 0, 0.8F));
  }
}

// In tangent space x points where s grows and y where t shrinks: with a mirrored picture both ways of finding the
// tangents turn x, or y, around.
TEST(VertexSources, TangentSpaceOfMirroredPictures) {
  Scene scene = one_triangle();
  const auto light_at_0 = [&](const Scene& of) {
    const std::vector<glm::vec4> tangents = tangents_of(of);
    return vector_at(VertexSource::tangent_light_vector, of, 0, &tangents);
  };
  EXPECT_EQ(light_at_0(scene), glm::vec3(3, 4, 12));
  scene.tangents.assign(3, {1, 0, 0, -1});
  EXPECT_EQ(light_at_0(scene), glm::vec3(3, -4, 12)) << "by the file's tangents";
  scene.tangents.clear();
  scene.texture_coordinates = {{1, 1}, {0, 1}, {1, 0}};
  EXPECT_EQ(light_at_0(scene), glm::vec3(-3, 4, 12)) << "by texture coordinates with s to the left";
  scene.texture_coordinates = {{0, 0}, {1, 0}, {0, 1}};
  EXPECT_EQ(light_at_0(scene), glm::vec3(3, -4, 12)) << "by texture coordinates with t upwards";
}

// GL's texture matrix, and a fourth coordinate only where it is not 1.
TEST(VertexSources, MatricesAndQ) {
  const Scene scene = one_triangle();
  glm::mat4 matrix(1.0F);
  matrix[0][1] = 2.0F;  // t = 2 s + t
  matrix[3][2] = 5.0F;  // r = r + 5 q
  const VertexInputs inputs{.scene = &scene};
  const UnitCoordinates moved = unit_coordinates({.source = VertexSource::position, .matrix = matrix}, inputs);
  EXPECT_EQ(moved.str[1], glm::vec3(2, 4, 5));
  EXPECT_TRUE(moved.q.empty());
  matrix[1][3] = 0.5F;  // q = q + t / 2: 2 at the third vertex alone
  const UnitCoordinates divided = unit_coordinates({.source = VertexSource::position, .matrix = matrix}, inputs);
  EXPECT_EQ(divided.q, (std::vector<float>{1, 1, 2}));
}

// The light of a lambert colour comes from behind for normals that turn away.
TEST(VertexSources, ColoursOfALight) {
  Scene scene = one_triangle();
  scene.lights[0].color = {1, 0.5F, 0};
  scene.materials[0].base_color = {0.5F, 1, 1};
  scene.normals = {{0, 0, 1}, {0, 0, -1}, {1, 0, 0}};
  scene.lights[0].kind = LightKind::directional;
  scene.lights[0].direction = {0, 0, -1};
  const std::vector<ColorBytes> colors =
      vertex_colors({.source = VertexSource::lambert}, {.scene = &scene}, profiles::geforce2);
  EXPECT_EQ(colors[0], (ColorBytes{128, 128, 0, 255}));
  EXPECT_EQ(colors[1], (ColorBytes{0, 0, 0, 255}));
  EXPECT_EQ(colors[2], (ColorBytes{0, 0, 0, 255}));
  const std::vector<ColorBytes> normals =
      vertex_colors({.source = VertexSource::normal}, {.scene = &scene}, profiles::geforce2);
  EXPECT_EQ(normals[0], (ColorBytes{128, 128, 255, 255}));
  EXPECT_EQ(normals[1], (ColorBytes{128, 128, 0, 255}));
}

TEST(VertexSources, SecondaryColoursAndFogFactorsOfTheMesh) {
  Scene scene = one_triangle();
  scene.secondary_colors = {{1, 0.2F, 0, 1}, {0, 0, 1, 0}, {0, 1, 0, 1}};
  scene.fog_factors = {0, 0.25F, 1};
  const std::vector<ColorBytes> colors =
      vertex_colors({.source = VertexSource::secondary_color}, {.scene = &scene}, profiles::geforce2);
  EXPECT_EQ(colors, (std::vector<ColorBytes>{{255, 51, 0, 255}, {0, 0, 255, 0}, {0, 255, 0, 255}}));
  EXPECT_EQ(fog_factors(parse_fog("mesh").value(), {.scene = &scene}), scene.fog_factors);
  EXPECT_FALSE(parse_fog("mesh:1").ok());
}

// Fog is measured along the view axis.
TEST(VertexSources, FogByDistanceAlongTheAxis) {
  Scene scene = one_triangle();
  scene.positions[1] = {40, 0, 3};
  const VertexInputs inputs{.scene = &scene};
  EXPECT_TRUE(fog_factors({}, inputs).empty());
  const std::vector<float> linear = fog_factors({.mode = FogMode::linear, .start = 1, .end = 9}, inputs);
  EXPECT_FLOAT_EQ(linear[0], 0.5F);
  EXPECT_FLOAT_EQ(linear[1], 0.875F);
  const std::vector<float> exp = fog_factors({.mode = FogMode::exp, .density = 0.25F}, inputs);
  EXPECT_FLOAT_EQ(exp[0], std::exp(-1.25F));
  const std::vector<float> exp2 = fog_factors({.mode = FogMode::exp2, .density = 0.25F}, inputs);
  EXPECT_FLOAT_EQ(exp2[0], std::exp(-1.5625F));
  // The chip's functions read the distance itself.
  const std::vector<float> distance = fog_factors(parse_fog("registers-exp2-abs:1.5,-0.25").value(), inputs);
  EXPECT_FLOAT_EQ(distance[0], 5.0F);
}

TEST(VertexSources, FogByTheChipsFunctions) {
  const EffectFog fog = parse_fog("registers-linear-abs:2,-0.5").value();
  EXPECT_EQ(fog.mode, FogMode::registers);
  EXPECT_EQ(fog.function, FogFunction::linear_abs);
  EXPECT_EQ(fog.bias, 2.0F);
  EXPECT_EQ(fog.slope, -0.5F);
  for (const char* const wrong : {"registers-exp3:1,1", "registers-exp:1", "registers-:1,1", "registers-exp:1,2,3"}) {
    const auto refused = parse_fog(wrong);
    ASSERT_FALSE(refused.ok()) << wrong;
    EXPECT_NE(refused.error().message.find("registers-FUNCTION:BIAS,SLOPE"), std::string::npos);
  }
}

// A row has the axis of tangent, bitangent and normal, and the eye's in q: the products of a tangent-space vector with
// the three rows are that vector in world space.
TEST(VertexSources, RowsTurnTangentSpaceIntoWorldSpace) {
  Scene scene = one_triangle();
  scene.normals.assign(3, glm::normalize(glm::vec3(0.2F, -0.1F, 0.9F)));
  const std::vector<glm::vec4> tangents = tangents_of(scene);
  const VertexInputs inputs{.scene = &scene, .tangents = &tangents};
  const glm::vec3 tangent(tangents[1]), bitangent = tangents[1].w * glm::cross(scene.normals[1], tangent);
  const glm::vec3 vector(0.3F, -0.5F, 0.8F);
  const glm::vec3 world = vector.x * tangent + vector.y * bitangent + vector.z * scene.normals[1];
  for (int axis = 0; axis < 3; ++axis) {
    const auto source = static_cast<VertexSource>(static_cast<int>(VertexSource::tangent_to_world_x) + axis);
    const UnitCoordinates row = unit_coordinates({.source = source}, inputs);
    EXPECT_NEAR(glm::dot(row.str[1], vector), world[axis], 1e-6F) << axis;
    EXPECT_EQ(row.q[1], scene.cameras[0].position[axis] - scene.positions[1][axis]) << axis;
  }
}

}  // namespace
}  // namespace ninebit::test
