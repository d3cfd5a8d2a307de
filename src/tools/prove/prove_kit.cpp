// `ninebit prove kit`: programs that an old card runs to show which values the open fields of its profile have.
#include <fmt/format.h>

#include <memory>

#include "ninebit/image/staged_files.h"
#include "ninebit/study/vectors.h"
#include "src/tools/common/kit_table.h"
#include "src/tools/common/output_file.h"
#include "src/tools/common/scene_flags.h"
#include "src/tools/input/printable.h"
#include "src/tools/prove/kit_source.h"
#include "src/tools/prove/prove.h"
#include "src/tools/prove/xbox_source.h"

namespace ninebit::tools {
namespace {

struct KitFlags {
  bool json = false, quiet = false;
  std::string family = "geforce2", target = "gl", folder;
};

// The texts of a kit's files but its programs.
struct KitTexts {
  std::string source, page;
  std::string makefile{};  // empty: the kit has none
};

Result<KitTexts> gl_texts(const ChipKit& kit) {
  auto source = kit_source(kit);
  if (!source) return source.error();
  return KitTexts{*std::move(source), kit_page(kit)};
}

Result<KitTexts> xbox_texts(const ChipKit& kit, ProgressLine& progress) {
  auto pack = make_vector_pack(kit.family, {}, [&](double done) { return progress.step("programs", done); });
  if (!pack) return pack.error();
  (void)print_vector_pack(*pack);  // which sets its id
  auto source = xbox_source(kit, *pack);
  if (!source) return source.error();
  return KitTexts{*std::move(source), xbox_page(kit, *pack), xbox_makefile()};
}

Result<std::vector<std::filesystem::path>> write_kit(const ChipKit& kit, const KitTexts& texts,
                                                     const std::string& folder) {
  auto files = StagedFiles::open(folder);
  if (!files) return files.error();
  if (Status written = write_staged(*files, "kit.c", texts.source); !written) return written.error();
  if (Status written = write_staged(*files, "README.md", texts.page); !written) return written.error();
  if (!texts.makefile.empty()) {
    if (Status written = write_staged(*files, "Makefile", texts.makefile); !written) return written.error();
  }
  for (std::size_t i = 0; i < kit.programs.size(); ++i) {
    if (Status written = write_staged(*files, kit_name(i) + ".rc1", kit.programs[i].rc10); !written)
      return written.error();
  }
  if (Status committed = files->commit(); !committed) return committed.error();
  return files->files();
}

Json json_of(const ChipKit& kit, const std::vector<std::filesystem::path>& files) {
  Json fields = Json::array(), programs = Json::array(), written = Json::array();
  for (const CombinerField& field : kit.fields) {
    Json values = Json::array();
    for (const FieldValue& value : field.values) values.push_back(value.word);
    fields.push_back({{"field", field.name}, {"evidence", name_of(field.evidence)}, {"values", std::move(values)}});
  }
  for (std::size_t i = 0; i < kit.programs.size(); ++i) {
    programs.push_back({{"name", kit_name(i)},
                        {"program", kit.programs[i].rc10},
                        {"general_combiners", kit.programs[i].general_combiners},
                        {"expected", kit.shown.front()[i]}});
  }
  for (const auto& file : files) written.push_back(file.string());
  return {{"command", "prove"},
          {"version", NINEBIT_VERSION},
          {"question", "kit"},
          {"family", kit.family.name},
          {"combinations", kit.combinations.size()},
          {"told_apart", kit.classes()},
          {"complete", kit.is_complete},
          {"fields", std::move(fields)},
          {"programs", std::move(programs)},
          {"files", std::move(written)}};
}

int run(const KitFlags& flags) {
  ProgressLine progress(flags.quiet || flags.json);
  const auto kit =
      make_chip_kit(profile_of_family(flags.family), [&](double done) { return progress.step("combinations", done); });
  if (!kit) return report(kit.error());
  const auto texts = flags.target == "xbox" ? xbox_texts(*kit, progress) : gl_texts(*kit);
  if (!texts) return report(texts.error());
  const auto files = write_kit(*kit, *texts, flags.folder);
  if (!files) return report(files.error());
  if (flags.json) return answer(json_of(*kit, *files));
  if (!flags.quiet) {
    for (const auto& file : *files) say_written(file);
  }
  return answer_exactly(fmt::format(
      "{} programs tell {} sets of the {} combinations of {} fields apart{}\n", kit->programs.size(), kit->classes(),
      kit->combinations.size(), kit->fields.size(),
      kit->is_complete ? "; nothing tells the others apart" : "; others may be told apart by programs not searched"));
}

}  // namespace

void add_prove_kit(CLI::App& prove, int& exit_code) {
  CLI::App* verb = prove.add_subcommand(
      "kit", "Write programs for an old card that show which values the open fields of its profile have");
  verb->footer(
      "The folder gets kit.c, one C file for OpenGL 1.x on Linux or Windows, README.md for the owner of the card, and\n"
      "the programs. On the card kit.c writes results.csv; `ninebit verify --decide results.csv` reads it. With\n"
      "--target xbox it is a program for nxdk, with a Makefile; nobody has run that on an Xbox yet.\n"
      "Example: ninebit prove kit --family geforce2 -o kit");
  auto flags = std::make_shared<KitFlags>();
  verb->add_flag("--json", flags->json, "Print one JSON object to stdout, and nothing else");
  verb->add_flag("--quiet", flags->quiet, "Do not print progress or the names of written files");
  add_family_flag(*verb, flags->family);
  verb->add_option("-o,--output", flags->folder, "Write the files to this folder")->required()->type_name("DIR");
  verb->add_option(
          "--target", flags->target,
          "What kit.c runs on: gl for OpenGL on Linux or Windows, xbox for a real Xbox with the free SDK nxdk; "
          "the latter has the programs of the family nv2a and those of a pack's first groups")
      ->capture_default_str()
      ->check(CLI::IsMember({"gl", "xbox"}));
  verb->callback([flags, verb, &exit_code] {
    if (flags->target == "xbox" && flags->family != "nv2a") {
      if (verb->get_option("--family")->count() != 0) {
        throw CLI::ValidationError("--target xbox: --family is " + flags->family + ", expected nv2a, the Xbox's chip");
      }
      flags->family = "nv2a";
    }
    exit_code = run(*flags);
  });
}

}  // namespace ninebit::tools
