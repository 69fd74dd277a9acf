// Mesh files, good and bad: read, put right with a remark, or refused with one line.
#include "path/mesh_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>

#include "anthrob_core/errors.h"
#include "path/mesh_surface.h"
#include "path/selected_mesh.h"
#include "support.h"

namespace anthrob {
namespace {

namespace fs = std::filesystem;

using Triangles = std::vector<std::array<Vec3, 3>>;

/// A tetrahedron-capped box of 12 triangles, facing outwards, 40 mm wide.
Triangles box(double half = 0.02) {
  const auto corner = [&](int i) {
    return Vec3(i & 1 ? half : -half, i & 2 ? half : -half, i & 4 ? half : -half);
  };
  const int quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                           {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  Triangles list;
  for (const auto& q : quads) {
    list.push_back({corner(q[0]), corner(q[1]), corner(q[2])});
    list.push_back({corner(q[0]), corner(q[2]), corner(q[3])});
  }
  return list;
}

std::string binary_stl(const Triangles& triangles) {
  std::string data(80, ' ');
  const auto put = [&](const void* p, std::size_t n) {
    data.append(static_cast<const char*>(p), n);
  };
  const auto count = static_cast<std::uint32_t>(triangles.size());
  put(&count, 4);
  for (const auto& triangle : triangles) {
    const float zero[3] = {0, 0, 0};
    put(zero, 12);
    for (const Vec3& p : triangle) {
      const float xyz[3] = {static_cast<float>(p.x()), static_cast<float>(p.y()),
                            static_cast<float>(p.z())};
      put(xyz, 12);
    }
    data.append(2, '\0');
  }
  return data;
}

class MeshFile : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("anthrob_mesh_" + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string write(const std::string& name, const std::string& data) {
    std::ofstream(folder_ / name, std::ios::binary) << data;
    return name;
  }

  std::shared_ptr<const MeshSurface> load(const std::string& file, const std::string& more = "") {
    const ConfigNode node = ConfigNode::parse("{file: '" + file + "', chi: [1, 0, 0]" + more + "}",
                                              (folder_ / "model.yaml").string());
    auto surface = MeshSurface::load(node, Pose());
    node.refuse_unknown_keys();
    return std::static_pointer_cast<const MeshSurface>(surface);
  }

  /// Refused with one line that names the model file and says `reason`.
  void expect_refusal(const std::string& file, const std::string& reason,
                      const std::string& more = "") {
    try {
      load(file, more);
      FAIL() << file << " was accepted";
    } catch (const BadInput& error) {
      const std::string text = error.what();
      EXPECT_NE(text.find("model.yaml"), std::string::npos) << text;
      EXPECT_NE(text.find(reason), std::string::npos) << text;
      EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    }
  }

  /// Accepted with a remark; the hull is that of the box.
  void expect_repair(const std::string& file, const std::string& remark) {
    const auto surface = load(file);
    EXPECT_EQ(surface->hull().vertices().size(), 8u);
    EXPECT_EQ(surface->hull().facet_count(), 12);
    std::string all;
    for (const std::string& line : surface->remarks()) all += line + "\n";
    EXPECT_NE(all.find(remark), std::string::npos) << all;
  }

  fs::path folder_;
};

TEST_F(MeshFile, SoundOnesOfThreeFormats) {
  EXPECT_TRUE(load(write("box.stl", binary_stl(box())))->remarks().empty());
  std::string obj;
  for (const auto& t : box()) {
    for (const Vec3& p : t) {
      obj += "v " + std::to_string(p.x()) + " " + std::to_string(p.y()) + " " +
             std::to_string(p.z()) + "\n";
    }
    obj += "f -3 -2 -1\n";
  }
  const auto from_obj = load(write("box.obj", obj));
  EXPECT_EQ(from_obj->hull().facet_count(), 12);
  EXPECT_TRUE(from_obj->remarks().empty());
}

/// A tetrahedron whose edges along x, y and z are 0.1, 0.2 and 0.3 units, moved by 1 along x.
std::string collada(const std::string& up_axis, const std::string& meter) {
  return R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="u" meter=")" +
         meter + R"("/><up_axis>)" + up_axis + R"(</up_axis></asset>
<library_geometries><geometry id="g"><mesh><source id="s"><float_array id="a" count="12">
0 0 0 0.1 0 0 0 0.2 0 0 0 0.3</float_array><technique_common><accessor source="#a" count="4" stride="3">
<param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor>
</technique_common></source><vertices id="v"><input semantic="POSITION" source="#s"/></vertices>
<triangles count="4"><input semantic="VERTEX" source="#v" offset="0"/><p>0 2 1 0 1 3 1 2 3 0 3 2</p></triangles>
</mesh></geometry></library_geometries><library_visual_scenes><visual_scene id="w"><node>
<translate>1 0 0</translate><instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#w"/></scene></COLLADA>)";
}

// A transform of the file's own counts, and its unit; what it calls up turns nothing, as in RViz.
TEST_F(MeshFile, ColladaAsRvizDrawsIt) {
  for (const std::string up_axis : {"X_UP", "Y_UP", "Z_UP"}) {
    for (const double meter : {1.0, 0.1}) {
      SCOPED_TRACE(up_axis + " " + std::to_string(meter));
      const auto surface = load(
          write(up_axis + std::to_string(meter) + ".dae", collada(up_axis, std::to_string(meter))));
      EXPECT_EQ(surface->hull().facet_count(), 4);
      Vec3 lo = surface->hull().vertices()[0], hi = lo;
      for (const Vec3& p : surface->hull().vertices()) lo = lo.cwiseMin(p), hi = hi.cwiseMax(p);
      EXPECT_LT((lo - meter * Vec3(1.0, 0.0, 0.0)).norm(), 1e-6);
      EXPECT_LT((hi - meter * Vec3(1.1, 0.2, 0.3)).norm(), 1e-6);
    }
  }
}

TEST_F(MeshFile, OffsetScaleAndPart) {
  const std::string file = write("box.stl", binary_stl(box(20.0)));
  const auto surface = load(
      file, ", scale: 0.001, offset: [1, 2, 3], part: [{point: [0, 0.005, 0], normal: [0, 2, 0]}]");
  Vec3 lo = surface->hull().vertices()[0], hi = lo;
  for (const Vec3& p : surface->hull().vertices()) lo = lo.cwiseMin(p), hi = hi.cwiseMax(p);
  EXPECT_LT((lo - Vec3(0.98, 2.005, 2.98)).norm(), 1e-8);
  EXPECT_LT((hi - Vec3(1.02, 2.02, 3.02)).norm(), 1e-8);
}

// Repaired.
TEST_F(MeshFile, Hole) {
  Triangles t = box();
  t.pop_back();
  expect_repair(write("hole.stl", binary_stl(t)), "3 open edges");
}
TEST_F(MeshFile, EdgeOfThreeFacets) {
  Triangles t = box();
  t.push_back({t[0][0], t[0][1], Vec3(0, 0, 0)});
  expect_repair(write("fin.stl", binary_stl(t)), "of more than two facets");
}
TEST_F(MeshFile, Inverted) {
  Triangles t = box();
  for (auto& triangle : t) std::swap(triangle[0], triangle[1]);
  expect_repair(write("inverted.stl", binary_stl(t)), "face inwards");
}
TEST_F(MeshFile, OneFacetInverted) {
  Triangles t = box();
  std::swap(t[3][0], t[3][1]);
  expect_repair(write("flipped.stl", binary_stl(t)), "face opposite ways");
}
TEST_F(MeshFile, FacetsWithoutArea) {
  Triangles t = box();
  t.push_back({t[0][0], t[0][0], t[0][1]});
  expect_repair(write("needle.stl", binary_stl(t)), "1 facet without area");
}
TEST_F(MeshFile, TheSameFacetTwice) {
  Triangles t = box();
  t.push_back(t[0]);
  expect_repair(write("double.stl", binary_stl(t)), "of more than two facets");
}

// Refused.
TEST_F(MeshFile, Missing) {
  expect_refusal("nowhere.stl", "no such file");
}
TEST_F(MeshFile, AFolder) {
  expect_refusal(".", "not a file");
}
TEST_F(MeshFile, Empty) {
  expect_refusal(write("empty.stl", ""), "empty");
}
TEST_F(MeshFile, Truncated) {
  const std::string data = binary_stl(box());
  expect_refusal(write("short.stl", data.substr(0, data.size() / 2)), "short.stl");
}
TEST_F(MeshFile, NotAMesh) {
  expect_refusal(write("prose.stl", "Call me Ishmael."), "prose.stl");
  expect_refusal(write("mesh.xyz", "1 2 3"), "mesh.xyz");
}
TEST_F(MeshFile, NotANumber) {
  Triangles t = box();
  t[2][1].x() = std::numeric_limits<double>::quiet_NaN();
  expect_refusal(write("nan.stl", binary_stl(t)), "not a finite number");
  t[2][1].x() = std::numeric_limits<double>::infinity();
  expect_refusal(write("inf.stl", binary_stl(t)), "not a finite number");
}
TEST_F(MeshFile, Millimetres) {
  expect_refusal(write("mm.stl", binary_stl(box(20.0))), "scale: 0.001");
}
TEST_F(MeshFile, TooSmall) {
  expect_refusal(write("dot.stl", binary_stl(box(2e-5))), "expected 0.002 to 3 m");
}
TEST_F(MeshFile, TooLarge) {
  expect_refusal(write("planet.stl", binary_stl(box(6e6))), "expected 0.002 to 3 m");
}
TEST_F(MeshFile, Flat) {
  Triangles t = box();
  for (auto& triangle : t) {
    for (Vec3& p : triangle) p.z() = 0.01;
  }
  expect_refusal(write("flat.stl", binary_stl(t)), "no volume");
}
TEST_F(MeshFile, ALine) {
  const Vec3 a(0, 0, 0), b(0.1, 0.1, 0.1), c(0.2, 0.2, 0.2);
  expect_refusal(write("line.stl", binary_stl({{a, b, c}})), "no volume");
}
TEST_F(MeshFile, NoTriangles) {
  expect_refusal(write("none.stl", binary_stl({})), "none.stl");
  expect_refusal(write("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"), "points.obj");
}
TEST_F(MeshFile, CutAway) {
  expect_refusal(write("box.stl", binary_stl(box())), "no part of the mesh",
                 ", part: [{point: [0, 0.1, 0], normal: [0, 1, 0]}]");
}
TEST_F(MeshFile, BadKeys) {
  const std::string file = write("box.stl", binary_stl(box()));
  expect_refusal(file, "scale", ", scale: -1");
  expect_refusal(file, "offset", ", offset: [1, 2]");
  expect_refusal(file, "normal", ", part: [{point: [0, 0, 0], normal: [0, 0, 0]}]");
  expect_refusal(file, "colour", ", colour: red");
  expect_refusal(file, "hull or half_space", ", selection: all");
}

TEST_F(MeshFile, SelectionByHalfSpaceKeepsAllVertices) {
  write("box.stl", binary_stl(box()));
  const ConfigNode node = ConfigNode::parse(
      "{file: box.stl, chi: [1, 0, 0], selection: half_space}", (folder_ / "model.yaml").string());
  const auto surface = MeshSurface::load(node, Pose());
  const auto* selected = dynamic_cast<const SelectedMesh*>(surface.get());
  ASSERT_NE(selected, nullptr);
  EXPECT_EQ(selected->vertices().size(), 8u);
  EXPECT_EQ(selected->type(), "mesh");
}

TEST_F(MeshFile, PreparedOnceForEveryDescription) {
  const std::string file = write("box.stl", binary_stl(box()));
  const auto first = load(file);
  EXPECT_EQ(load(file), first);
  EXPECT_NE(load(file, ", offset: [0.001, 0, 0]"), first);
  const std::string half = ", part: [{point: [0, 0, 0], normal: [0, 1, 0]}]";
  const auto part = load(file, half);
  EXPECT_NE(part, first);
  EXPECT_EQ(load(file, half), part);
  // An unknown key is refused however often the surface was prepared.
  for (int i = 0; i < 2; ++i) {
    expect_refusal(file, "colour", ", part: [{point: [0, 0, 0], normal: [0, 1, 0], colour: red}]");
  }
  write("box.stl", binary_stl(box(0.021)));  // the file has changed
  const auto larger = load(file);
  EXPECT_NE(larger, first);
  EXPECT_GT(larger->hull().size(), first->hull().size());
}

}  // namespace
}  // namespace anthrob
