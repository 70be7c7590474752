#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "brdf/render/mesh_io.hpp"
#include "copula/error.hpp"
#include "copula/file.hpp"
#include "tests/support/message.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sklar::brdf {
namespace {
using std::numbers::pi;

constexpr double kRounding = 1e-14;

double area(const TriangleMesh& mesh) {
  double sum = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) sum += 0.5 * area_vector(mesh, i).norm();
  return sum;
}

/// By the divergence theorem; positive if the front is outside.
double volume(const TriangleMesh& mesh) {
  double sum = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    sum += area_vector(mesh, i).dot(mesh.vertices[static_cast<std::size_t>(mesh.triangles[i][0])]) / 6;
  }
  return sum;
}

std::string refusal(const TriangleMesh& mesh) {
  return test::message_of<std::invalid_argument>([&] { require_mesh(mesh); });
}

TEST(Mesh, ShapesAreClosedAndFaceOutward) {
  const TriangleMesh cube = box({1, 2, 3});
  EXPECT_NO_THROW(require_mesh(cube));
  EXPECT_NEAR(area(cube), 22, 22 * kRounding);
  EXPECT_NEAR(volume(cube), 6, 6 * kRounding);
  constexpr double kPolygons = 0.004;  // a circle as a polygon of 48 sides
  const TriangleMesh ring = torus(2, 0.5);
  EXPECT_NO_THROW(require_mesh(ring));
  EXPECT_NEAR(area(ring) / (4 * pi * pi * 2 * 0.5), 1, kPolygons);
  EXPECT_NEAR(volume(ring) / (2 * pi * pi * 2 * 0.25), 1, kPolygons);
  std::vector<Vec2> half_circle;
  for (int k = 0; k <= 16; ++k) half_circle.emplace_back(std::sin(pi * k / 16), -std::cos(pi * k / 16));
  half_circle.front().x() = half_circle.back().x() = 0;
  const TriangleMesh ball = revolution(half_circle);
  EXPECT_NO_THROW(require_mesh(ball));
  EXPECT_NEAR(area(ball) / (4 * pi), 1, kPolygons);
  EXPECT_NEAR(volume(ball) / (4 * pi / 3), 1, kPolygons);
  for (std::size_t i = 0; i < ball.vertices.size(); ++i) {
    EXPECT_GT(ball.normals[i].dot(ball.vertices[i].normalized()), 0.995) << i;
  }
}

TEST(Mesh, IsPlaced) {
  const TriangleMesh mesh =
      placed(rectangle({0, 0, 0}, {0, 0, 1}, {1, 0, 0}), {.scale = 2, .turn = pi / 2, .at = {5, 6, 7}});
  EXPECT_LT((mesh.vertices[1] - Vec3(7, 6, 7)).norm(), 1e-14) << "z turns toward x";
  EXPECT_LT((area_vector(mesh, 0) - Vec3(0, 4, 0)).norm(), 1e-14);
}

TEST(Mesh, BadOnesAreRefusedByNumber) {
  const TriangleMesh good = rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  EXPECT_EQ(refusal({}), "the mesh has no triangles");
  TriangleMesh mesh = good;
  mesh.vertices[2].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refusal(mesh), "vertex 3 is not finite");
  mesh = good;
  mesh.triangles[1][0] = 4;
  EXPECT_EQ(refusal(mesh), "triangle 2 names vertex 5 of 4");
  mesh = good;
  mesh.triangles[1][2] = mesh.triangles[1][1];
  EXPECT_EQ(refusal(mesh), "triangle 2 is degenerate: it has no area");
  mesh = good;
  mesh.vertices[3] = Vec3(2, 2, 0);
  EXPECT_EQ(refusal(mesh), "triangle 2 is degenerate: it has no area") << "three points of a line";
  mesh = good;
  mesh.normals.assign(3, Vec3::UnitZ());
  EXPECT_EQ(refusal(mesh), "the mesh has 3 normals for 4 vertices");
  mesh.normals.assign(4, Vec3(0, 0, 2));
  EXPECT_EQ(refusal(mesh), "normal 1 is not of length 1");
  EXPECT_THROW((void)torus(1, 1), std::domain_error);
  EXPECT_THROW((void)revolution(std::vector<Vec2>{{1, 0}}), std::invalid_argument);
  EXPECT_THROW((void)revolution(std::vector<Vec2>{{1, 0}, {1, 0}}), std::invalid_argument);
  EXPECT_THROW((void)revolution(std::vector<Vec2>{{1, 0}, {0, 1}, {1, 2}}), std::domain_error);
}

constexpr const char* kPyramid = R"(# comment
o pyramid
v 0 0 0
v 1 0 0
v 1 1 0 # corner
v 0 1 0
v .5 .5 1e0
f 4 3 2 1
f 1 2 5
f -4 -3 -1
)";

TEST(Obj, PolygonsNormalsAndBackwardIndices) {
  const TriangleMesh mesh = parse_obj(kPyramid);
  ASSERT_EQ(mesh.triangles.size(), 4U);
  EXPECT_EQ(mesh.vertices.size(), 5U);
  EXPECT_TRUE(mesh.normals.empty());
  EXPECT_EQ(area_vector(mesh, 0), Vec3(0, 0, -1));
  EXPECT_EQ(area_vector(mesh, 1), Vec3(0, 0, -1));
  EXPECT_EQ(mesh.vertices[static_cast<std::size_t>(mesh.triangles[3][0])], Vec3(1, 0, 0));
  const TriangleMesh smooth =
      parse_obj("v 0 0 0\nv 1 0 0\r\nv 0 1 0\nvt 0 0\nvn 0 0 2\nvn 0 1 1\nf 1//1 2/1/1 3//2\nf 1//2 2//1 3//2\n");
  ASSERT_EQ(smooth.normals.size(), 4U) << "a vertex with two normals is two";
  EXPECT_EQ(smooth.normals[0], Vec3(0, 0, 1));
  EXPECT_NEAR(smooth.normals[2].norm(), 1, kRounding);
}

TEST(Obj, BadLinesAreNamed) {
  const auto refused = [](const char* text) {
    return test::message_of<std::invalid_argument>([&] { (void)parse_obj(text); });
  };
  EXPECT_EQ(refused("v 0 0 0\nv 1 nan 0\n"), "line 2: a coordinate is not finite");
  EXPECT_EQ(refused("v 0 0\n"), "line 1: expected a coordinate, found ''");
  EXPECT_EQ(refused("v 0 0 x\n"), "line 1: expected a coordinate, found 'x'");
  EXPECT_EQ(refused("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n"), "line 4: names vertex 4 of 3");
  EXPECT_EQ(refused("v 0 0 0\nf 0 1 1\n"), "line 2: names vertex 0 of 1");
  EXPECT_EQ(refused("v 0 0 0\nf 1 1 -2\n"), "line 2: names vertex -2 of 1");
  EXPECT_EQ(refused("v 0 0 0\nf 1 1\n"), "line 2: a face needs three corners, found 2");
  EXPECT_EQ(refused("v 0 0 0\nf 1//1 1 1\n"), "line 2: names normal 1 of 0");
  EXPECT_EQ(refused("vn 0 0 0\n"), "line 1: the normal has no length");
}

constexpr const char* kHeader =
    "comment made by hand\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n";

template <class T>
std::string raw(T value) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  return bytes;
}

std::string binary_square() {
  std::string bytes = "ply\nformat binary_little_endian 1.0\n" + std::string(kHeader);
  for (const auto& [x, y] : {std::pair(0.F, 0.F), {1.F, 0.F}, {1.F, 1.F}, {0.F, 1.F}}) {
    bytes += raw(x) + raw(y) + raw(0.5F) + raw(std::uint8_t{255});
  }
  bytes += raw(std::uint8_t{4});
  for (const std::int32_t index : {0, 1, 2, 3}) bytes += raw(index);
  return bytes;
}

TEST(Ply, AsciiAndBinaryAreTheSame) {
  const TriangleMesh text = parse_ply("ply\nformat ascii 1.0\n" + std::string(kHeader) +
                                      "0 0 .5 255\n1 0 .5 255\n1 1 .5 0\n0 1 .5 0\n4 0 1 2 3\n");
  const TriangleMesh binary = parse_ply(binary_square());
  ASSERT_EQ(binary.triangles.size(), 2U);
  EXPECT_EQ(binary.triangles, text.triangles);
  EXPECT_EQ(binary.vertices, text.vertices);
  EXPECT_EQ(binary.vertices[2], Vec3(1, 1, 0.5));
  EXPECT_NO_THROW(require_mesh(binary));
}

TEST(Ply, BadFilesAreRefused) {
  const auto refused = [](const std::string& bytes) {
    return test::message_of<std::invalid_argument>([&] { (void)parse_ply(bytes); });
  };
  const auto changed = [](const std::string& from, const std::string& to) {
    std::string bytes = binary_square();
    return bytes.replace(bytes.find(from), from.size(), to);
  };
  EXPECT_EQ(refused(""), "the header has no end");
  EXPECT_EQ(refused("obj\n"), "does not begin with 'ply'");
  EXPECT_NE(refused(changed("binary_little_endian", "binary_big_endian")).find("format binary_big_endian"),
            std::string::npos);
  EXPECT_EQ(refused(changed("vertex 4", "vertex 4000000000")).find("promises 4000000000 of element 'vertex'"), 0U);
  EXPECT_EQ(refused(changed("face 1", "face 99999")).find("promises 99999 of element 'face'"), 0U);
  EXPECT_EQ(refused(changed("vertex 4", "vertex -4")), "the count of an element must be a number, found '-4'");
  EXPECT_EQ(refused(changed("float z", "float w")), "element 'vertex' has no property z");
  EXPECT_EQ(refused(changed("float z", "half z")), "unknown type 'half' of a property");
  EXPECT_EQ(refused(changed("vertex_indices", "corners")), "element 'face' has no property vertex_indices");
  std::string bytes = binary_square();
  bytes.pop_back();
  EXPECT_EQ(refused(bytes), "the file ends too soon");
  bytes = binary_square();
  bytes.replace(bytes.size() - 4, 4, raw(std::int32_t{4}));
  EXPECT_EQ(refused(bytes), "face 1 names vertex 4 of 4, counted from 0");
  bytes.replace(bytes.size() - 4, 4, raw(std::int32_t{-1}));
  EXPECT_EQ(refused(bytes).find("an index must be a whole number from 0 on, found -1"), 0U);
}

using MeshFile = test::TemporaryFolder;

TEST_F(MeshFile, ErrorsNameTheFile) {
  const auto refused = [&](const std::string& name, std::string_view bytes) {
    write_file(folder_ / name, bytes);
    return test::message_of<FileError>([&] { (void)read_mesh(folder_ / name); });
  };
  EXPECT_NE(refused("a.stl", "x").find("a.stl: a mesh ends in .obj or .ply"), std::string::npos);
  EXPECT_NE(refused("a.obj", "").find("a.obj: the mesh has no triangles"), std::string::npos);
  EXPECT_NE(refused("b.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n").find("b.obj: triangle 1 is degenerate"),
            std::string::npos);
  std::string bytes = binary_square();
  const std::size_t first = bytes.find("end_header\n") + 11;
  bytes.replace(first, 4, raw(std::numeric_limits<float>::quiet_NaN()));
  EXPECT_NE(refused("c.ply", bytes).find("c.ply: vertex 1 is not finite"), std::string::npos);
  EXPECT_NE(test::message_of<FileError>([&] { (void)read_mesh(folder_ / "none.ply"); }).find("no such file"),
            std::string::npos);
  write_file(folder_ / "d.ply", binary_square());
  EXPECT_EQ(read_mesh(folder_ / "d.ply").triangles.size(), 2U);
}

}  // namespace
}  // namespace sklar::brdf
