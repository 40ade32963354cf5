// SPDX-License-Identifier: BSD-3-Clause
// Files of a megabyte that say the same over and over, longer than those that libFuzzer makes: every reader ends with a
// result or with a meam::Error. In a time that grew with the square of their length it would take minutes, and the
// test's time limit ends it.
#include "Trial.h"

#include <gtest/gtest.h>

namespace
{
constexpr std::size_t Length = (1 << 20) - 256; // some readers refuse more

struct LongFile
{
  const char* reader;
  std::string head;
  std::string repeated;
};

void PrintTo(const LongFile& file, std::ostream* out)
{
  *out << file.reader << ": " << testing::PrintToString(file.head) << testing::PrintToString(file.repeated) << "...";
}

std::vector<LongFile> longFiles()
{
  const std::string ply = "ply\nformat ascii 1.0\n";
  const std::string vertex = "element vertex 1\nproperty float x\nproperty float y\nproperty float z\n";
  std::vector<LongFile> files = {
    { "stl", "solid a\n", "vertex 0 0 0\n" },
    { "stl", "solid a\n", "\n" },
    { "obj", "", "v 0 0 0\n" },
    { "obj", "v 0 0 0\n", "f 1 1 1\n" },
    { "obj", "v 0 0 0\nf", " 1" },
    { "off", "OFF\n1 1 0\n0 0 0\n500000", " 0" },
    { "off", "OFF\n1 300000 0\n0 0 0\n", "0\n" },
    { "step", "ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\n", "#1=CARTESIAN_POINT('',(0.,0.,0.));\n" },
    { "iges", std::string(72, ' ') + "S      1\n", std::string(72, ' ') + "P      1\n" },
    { "ply-mesh", ply + vertex + "element face 1\nproperty list int int vertex_indices\nend_header\n0 0 0\n500000",
      " 0" },
    { "ply-mesh", ply, "element a 0\n" },
    { "ply-mesh", ply + vertex, "property float x\n" },
    { "ply-cloud", ply, "comment\n" },
    { "pcd", "FIELDS", " x" },
    { "pcd", "", "#\n" },
    { "pcd", "FIELDS x\nSIZE 4\nTYPE F\nCOUNT 1\nWIDTH 500000\nHEIGHT 1\nDATA ascii\n", "0 " },
    { "image", "\xff\xd8", "\xff" },
    { "model", std::string("\x89MEAM\r\n\x1a\x04\0\0\0", 12), std::string("\0\0\0\0c\0\0\0\0\0\0\0\0", 13) },
    { "camera", "%YAML:1.0\n", "\n" },
    { "camera", "%YAML:1.0\n", "a\n" },
    { "camera", "%YAML:1.0\n", "a: []\n" },
    { "camera", "%YAML:1.0\n", "a: !\n" },
    { "camera", "", "%YAML:1.0\n" },
    { "camera", "a: [", "0, " },
    { "camera", "a: [", "[], " },
    { "camera", "a: [", "{a}, " },
    { "camera", "a: {", "a: 1, " },
    { "camera", "a: ", "[" },
    { "camera", "a: \"", "\\t" },
    { "camera", "a: |\n", " a\n" },
    { "camera", "", "? " },
    { "camera", "", "&a " },
    { "camera", "", "# a\n" },
    { "camera", "", "---\n" },
    { "camera", "", "<a>" },
    { "camera", "<a>", "<!-- -->" },
    { "camera", "<a><b>", "1 " },
    { "robot-frame", "T_robot_camera\n", "\n" },
    { "robot-frame", "a:\n", "- " },
    { "robot-frame", "a:\n", "- x: 1\n" },
    { "robot-frame", "", "1 " },
    { "hand-eye", "", "1 " },
    { "poses", "", "#\n" },
    { "poses", "scene_id,im_id,obj_id,score,R,t,time\n", "1,1,1,1,1 0 0 0 1 0 0 0 1,0 0 0,1\n" },
    { "truth", "{", "\"2\":[]," },
    { "scene-camera", "{", "\"2\":{}," },
  };
  const std::pair<const char*, const char*> lists[] = { { "camera", "{\"camera_matrix\":[" },
    { "robot-frame", "{\"T_robot_camera\":[" }, { "hand-eye", "{\"pairs\":[" }, { "poses", "{\"poses\":[" },
    { "grasps", "{\"grasps\":[" }, { "truth", "{\"2\":[" }, { "models-info", "{\"1\":{\"symmetries_discrete\":[" } };
  for (const auto& [reader, head] : lists)
  {
    for (const char* entry : { "0,", "[],", "{}," })
    {
      files.push_back({ reader, head, entry });
    }
  }
  return files;
}

class LongFiles : public testing::TestWithParam<LongFile>
{
};
}

INSTANTIATE_TEST_SUITE_P(Quick, LongFiles, testing::ValuesIn(longFiles()));

TEST_P(LongFiles, areReadToTheirEnd)
{
  const LongFile& file = GetParam();
  const fuzz::Reader* reader = fuzz::readerOf(file.reader);
  ASSERT_TRUE(reader);
  std::string bytes = file.head;
  while (bytes.size() < Length)
  {
    bytes += file.repeated;
  }
  const fuzz::Trial trial(*reader);
  trial.reads(reader->mend ? reader->mend(bytes) : bytes);
}
