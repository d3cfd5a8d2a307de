// Names of files that stand in files: every reader asks the one rule which of them it may read. What that rule says of
// names of all kinds is tested in combiner_tests/system/inside_folder_test.cpp.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "combiner_tests/tools/program_support.h"
#include "combiner_tests/tools/support.h"
#include "ninebit/image/image_io.h"
#include "ninebit/study/study_part.h"
#include "src/study/part/part_text.h"
#include "src/system/hashing/openssl.h"

namespace tools_test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kTex0 = "!!RC1.0\nout.rgb = tex0; # TOPSECRET\nout.a = tex0;\n";
constexpr const char* kSquareMesh =
    "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl a\nf 1/1 2/2 3/3 4/4\n";

// The readers of files whose names stand in other files.
struct Reader {
  std::string what;
  std::string extension;  // of the file that is read
  std::string content;    // that the reader accepts
  // Reads the name in the file `in/` + something, from the folder `in`.
  std::function<Outcome(const std::string& name, const Words& more)> read;
  bool is_json = false;          // whether the file can hold any character
  bool ignores_missing = false;  // whether a file that is not there is no error
};

// The folder "in" has the files that may be read, and "out" beside it those that may not.
class NamedFiles : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* folder : {"in/sub", "out"}) fs::create_directories(folder_.path() / folder);
    ASSERT_EQ(::mkfifo((folder_ / "in/fifo").c_str(), 0600), 0);
    fs::create_directory_symlink("sub", folder_ / "in/linked");
    fs::create_symlink("/dev/zero", folder_ / "in/zero");
    ninebit::Image8 image{4, 4, 3, std::vector<std::uint8_t>(48, 200)};
    ASSERT_TRUE(ninebit::write_png(folder_ / "picture.png", image));
    picture_ = read_bytes(folder_ / "picture.png");
  }

  [[nodiscard]] std::string in(const std::string& name) const { return folder_ / ("in/" + name); }

  // Puts the reader's file where it may be read and where it may not.
  void put(const Reader& reader) const {
    const std::string& e = reader.extension;
    for (const std::string& name : {"plain" + e, "sub/plain" + e, "\xC3\xA9" + e}) {
      write_bytes(in(name), reader.content);
    }
    write_bytes(folder_ / ("out/secret" + e), reader.content);
    for (const auto& [link, to] : {std::pair{"link", "sub/plain"}, {"way_out", "../out/secret"}}) {
      fs::remove(in(link + e));
      fs::create_symlink(to + e, in(link + e));
    }
  }

  [[nodiscard]] static Words names_inside(const std::string& e) {
    return {"./sub//plain" + e, "link" + e, "linked/plain" + e, "\xC3\xA9" + e};
  }

  // Names of files that exist and are only read if that is allowed.
  [[nodiscard]] Words names_outside(const std::string& e) const {
    return {"../out/secret" + e, in("plain" + e), "way_out" + e};
  }

  // Names of what is never read.
  [[nodiscard]] static Words names_of_nothing(const std::string& e, bool is_json) {
    Words names{"../../../../../../../../etc/passwd",
                "/dev/stdin",
                "file:///etc/passwd",
                "..\\out\\secret" + e,
                "%2e%2e/out/secret" + e,
                "fifo",
                "zero",
                "sub",
                "none" + e,
                "\x1b[31m" + e,
                std::string(5000, 'x') + e};
    if (is_json) names.insert(names.end(), {std::string("\0../out/secret", 14), "../\n" + e});
    return names;
  }

  void expect_the_same_of_every_name(const Reader& reader) const {
    SCOPED_TRACE(reader.what);
    put(reader);
    const std::string& e = reader.extension;
    for (const std::string& name : names_inside(e)) {
      const Outcome outcome = reader.read(name, {});
      EXPECT_EQ(outcome.code, 0) << name << ": " << outcome.err;
    }
    const auto expect_refused = [&](const std::string& name, const Words& more) {
      if (HasFailure()) return;  // one name tells enough
      SCOPED_TRACE(testing::PrintToString(name.substr(0, 60)));
      const Outcome outcome = reader.read(name, more);
      std::error_code unknown;
      const bool may_be_missing = reader.ignores_missing && !fs::exists(in(name), unknown);
      if (!may_be_missing || outcome.code != 0) expect_error(outcome, 3, {});
      EXPECT_EQ(outcome.err.find("TOPSECRET"), std::string::npos) << outcome.err;
      EXPECT_EQ(outcome.err.find("root:"), std::string::npos) << outcome.err;
      EXPECT_EQ(outcome.err.find('\x1b'), std::string::npos) << outcome.err;
      EXPECT_LT(outcome.err.size(), 2100U) << outcome.err.substr(0, 2000);
      if (more.empty() && (name.starts_with("..") || name.starts_with('/'))) {
        expect_parts(outcome.err, {"--allow-outside"});
      }
    };
    for (const std::string& name : names_outside(e)) {
      expect_refused(name, {});
      const Outcome allowed = reader.read(name, {"--allow-outside"});
      EXPECT_EQ(allowed.code, 0) << name << ": " << allowed.err;
    }
    for (const std::string& name : names_of_nothing(e, reader.is_json)) expect_refused(name, {});
    for (const char* name : {"fifo", "/dev/zero"}) expect_refused(name, {"--allow-outside"});
  }

  // Draws an effect with these members.
  [[nodiscard]] Outcome draw(const std::string& members, const Words& more) const {
    write_effect(members);
    return ninebit(Words{"draw", in("effect.json"), "-o", folder_ / "drawn.png", "--quiet"} + more);
  }
  void write_effect(const std::string& members) const {
    write_bytes(in("effect.json"), R"({"ninebit": "effect", "version": 1, "size": 8, )" + members + "}");
  }
  [[nodiscard]] static std::string quoted(const std::string& name) { return Json(name).dump(); }
  [[nodiscard]] static std::string textured(const std::string& source) {
    return R"("textures": {"t": {"source": )" + quoted(source) +
           R"(}}, "passes": [{"program": "own.rc1", "units": [{"texture": "t"}]}])";
  }
  [[nodiscard]] static std::string programmed(const std::string& name) {
    return R"("passes": [{"program": )" + quoted(name) + "}]";
  }

  TempFolder folder_;
  std::string picture_;
};

TEST_F(NamedFiles, OfEffects) {
  write_bytes(in("own.rc1"), kTex0);
  write_bytes(in("face.png"), picture_);
  const std::string four = ",face.png,face.png,face.png,face.png";
  expect_the_same_of_every_name({"program", ".rc1", kTex0,
                                 [&](const auto& name, const auto& more) { return draw(programmed(name), more); },
                                 true});
  expect_the_same_of_every_name({"texture", ".png", picture_,
                                 [&](const auto& name, const auto& more) { return draw(textured(name), more); }, true});
  expect_the_same_of_every_name(
      {"height map", ".png", picture_,
       [&](const auto& name, const auto& more) { return draw(textured("normals:" + name), more); }, true});
  expect_the_same_of_every_name(
      {"face of a cube map", ".png", picture_,
       [&](const auto& name, const auto& more) { return draw(textured("face.png," + name + four), more); }, true});
  expect_the_same_of_every_name({"mesh", ".obj", kSquareMesh,
                                 [&](const auto& name, const auto& more) {
                                   return draw(R"("scene": {"mesh": )" + quoted(name) + R"(}, "passes": [{}])", more);
                                 },
                                 true});
}

TEST_F(NamedFiles, OfATracedEffect) {
  const auto trace = [&](const std::string& name, const Words& more) {
    write_effect(programmed(name));
    return ninebit(Words{"trace", "--effect", in("effect.json"), "--pixel", "1,1", "--quiet"} + more);
  };
  expect_the_same_of_every_name({"program", ".rc1", kTex0, trace, true});
}

TEST_F(NamedFiles, OfScenes) {
  const auto render = [&](const std::string& file, const Words& more) {
    return ninebit(small_render(in(file), folder_ / "rendered", {"--quiet"}) + more);
  };
  write_bytes(in("m.obj"), kSquareMesh);
  expect_the_same_of_every_name({"material library", ".mtl", "newmtl a\nKd 1 0 0\n# TOPSECRET\n",
                                 [&](const auto& name, const auto& more) {
                                   write_bytes(in("s.obj"), "mtllib " + name + "\n" + kSquareMesh);
                                   return render("s.obj", more);
                                 },
                                 false, true});
  write_bytes(in("t.obj"), std::string("mtllib t.mtl\n") + kSquareMesh);
  expect_the_same_of_every_name(
      {"texture of a material library", ".png", picture_, [&](const auto& name, const auto& more) {
         write_bytes(in("t.mtl"), "newmtl a\nmap_Kd " + name + "\n");
         return render("t.obj", more);
       }});
  const std::vector<float> corners{0, 0, 0, 1, 0, 0, 0, 1, 0};
  const std::string buffer(reinterpret_cast<const char*>(corners.data()), 36);
  const auto gltf = [](const std::string& buffer_name, const std::string& members) {
    return R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
      "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": 0}]}],
      "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
                    {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC2"}],
      "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36, "uri": )" +
           quoted(buffer_name) + "}], " + members + "}";
  };
  expect_the_same_of_every_name({"buffer", ".bin", buffer,
                                 [&](const auto& name, const auto& more) {
                                   write_bytes(in("s.gltf"), gltf(name, R"("materials": [{}])"));
                                   return render("s.gltf", more);
                                 },
                                 true});
  write_bytes(in("own.bin"), buffer);
  expect_the_same_of_every_name({"image", ".png", picture_,
                                 [&](const auto& name, const auto& more) {
                                   write_bytes(in("t.gltf"), gltf("own.bin", R"("images": [{"uri": )" + quoted(name) +
                                                                                 R"(}], "textures": [{"source": 0}],
           "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}])"));
                                   return render("t.gltf", more);
                                 },
                                 true});
}

TEST_F(NamedFiles, OfTables) {
  expect_the_same_of_every_name({"program of a row", ".rc1", kTex0, [&](const auto& name, const auto& more) {
                                   write_bytes(in("rows.csv"), "program,tex0.r,out.r\n" + name + ",255,255\n");
                                   return ninebit(Words{"verify", in("rows.csv"), "--quiet"} + more);
                                 }});
}

// The names of a part are relative to the working folder.
TEST_F(NamedFiles, OfPartsOfStudies) {
  const std::string program = read_bytes(NINEBIT_SOURCE_DIR "/docs/programs/index_compare.gl");
  write_bytes(in("plain.gl"), program);
  const ChildSettings in_folder{.folder = in("")};
  const Words study{"study", "index-steps", "--program", "plain.gl", "--formats", "channel", "--steps",
                    "1",     "--profile",   "geforce2",  "--quiet",  "-o",        "run"};
  ASSERT_EQ(ninebit(study, in_folder).code, 0);
  const auto part = ninebit::read_part(in("run/part-1-of-1.jsonl"));
  ASSERT_TRUE(part) << part.error().text();
  const auto merge = [&](const std::string& name, const Words& more) {
    ninebit::PartHeader header = part->header;
    for (auto& [option, value] : header.question.options) {
      if (value == "plain.gl") value = name;
      if (option == "sha256 of plain.gl") option = "sha256 of " + name;
    }
    std::string text = ninebit::header_line(header);
    for (const auto& unit : part->units) text += ninebit::unit_line(unit);
    write_bytes(in("part.jsonl"), text + ninebit::end_line(part->units.size(), ninebit::sha256(text)));
    return ninebit(Words{"study", "merge", "part.jsonl", "--quiet", "-o", "merged"} + more, in_folder);
  };
  expect_the_same_of_every_name({"program", ".gl", program, merge, true});
}

}  // namespace
}  // namespace tools_test
