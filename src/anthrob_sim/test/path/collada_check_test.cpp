// Damaged COLLADA files: what the library that reads them dies or hangs of is refused before.
#include "path/collada_check.h"

#include <gtest/gtest.h>

#include "path/mesh_file.h"
#include "support.h"

namespace anthrob {
namespace {

const char kTetrahedron[] = R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="meter" meter="1"/><up_axis>Z_UP</up_axis></asset>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="a" count="12">0 0 0 0.1 0 0 0 0.1 0 0 0 0.1</float_array>
<technique_common><accessor source="#a" count="4" stride="3"><param name="X" type="float"/>
<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="4"><input semantic="VERTEX" source="#v" offset="0"/>
<p>0 2 1 0 1 3 0 3 2 1 2 3</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n"><instance_geometry url="#g"/></node>
</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>
)";

/// What is said of the tetrahedron in which the first `words` are others.
std::string refusal_with(const std::string& words, const std::string& others) {
  std::string text = kTetrahedron;
  const std::size_t at = text.find(words);
  EXPECT_NE(at, std::string::npos) << words;
  text.replace(at, words.size(), others);
  testing_support::TemporaryRobot folder("", "");
  folder.write("mesh.dae", text);
  try {
    read_mesh(std::filesystem::path(folder.file()).parent_path() / "mesh.dae");
    return "";
  } catch (const std::runtime_error& error) {
    return error.what();
  }
}

TEST(ColladaCheck, ASoundFileIsRead) {
  EXPECT_EQ(refusal_with("meter", "meter"), "");
}

TEST(ColladaCheck, RefusesControlCharacters) {
  const std::string not_allowed = "which XML does not allow";
  EXPECT_EQ(refusal_with("<p>0 2 1 0", "<p>0 2 1\f0"),
            "line 10: control character 12, " + not_allowed);
  EXPECT_EQ(refusal_with("meter", "me\vter"), "line 3: control character 11, " + not_allowed);
  EXPECT_EQ(refusal_with("0.1 0 0", std::string("0.1\0 0", 6)),
            "line 5: control character 0, " + not_allowed);
  EXPECT_EQ(refusal_with("<p>0 2 1 0", "<p>0\t2\r1\n0"), "");
}

TEST(ColladaCheck, SaysLineElementAndWhatWasExpected) {
  EXPECT_EQ(refusal_with("count=\"12\"", "count=\",\""),
            "line 5: <float_array>: count=\",\": expected a whole number");
  EXPECT_EQ(refusal_with("count=\"12\"", "count=\"13\""),
            "line 5: <float_array>: count=\"13\": but it has 12 numbers");
  EXPECT_EQ(refusal_with("0.1 0 0 0 0.1<", "0.1 0 0 nan 0.1<"),
            "line 5: <float_array>: 'nan': expected a number");
  EXPECT_EQ(refusal_with("triangles count=\"4\"", "triangles count=\"18446744073709551616\""),
            "line 9: <triangles>: count=\"18446744073709551616\": expected a whole number");
  EXPECT_EQ(refusal_with("<p>0 2 1", "<p>0 2(1"), "line 10: <p>: '2(1': expected a whole number");
  EXPECT_EQ(refusal_with("source=\"#a\"", "source=\"#b\""),
            "line 6: <accessor>: source=\"#b\": expected the id of an element");
  EXPECT_EQ(refusal_with("<p>0 2 1 0 1 3 0 3 2 1 2 3</p>", ""),
            "line 9: <triangles>: count=\"4\": but it has 0 indices");
  EXPECT_NE(refusal_with("</mesh>", "").find("not XML"), std::string::npos);
}

}  // namespace
}  // namespace anthrob
