// tinsmith info: what is in a file.

#include <algorithm>
#include <cstdio>
#include <memory>

#include "input_flags.hpp"
#include "inputs.hpp"
#include "report.hpp"
#include "text.hpp"
#include "tinsmith/describe.hpp"
#include "verbs.hpp"

namespace tinsmith::cli {
namespace {

constexpr const char* kManual =
    R"(tinsmith info: says what is in a raster or mesh file.

usage: tinsmith info FILE [options]

Of a raster: format, size, type, nodata, CRS, steps in CRS units and metres, extent, the lowest and highest valid
sample, and how many are valid (all of it is read, block by block). Of a mesh (.ply .obj .glb .2dm): vertices,
triangles, components, CRS, extent and heights. Of any other surface that simplify reads (.ply .obj .glb .stl .tspm):
vertices, triangles, values at the vertices, and ranges of x, y and z.

options:
)" TINSMITH_INPUT_MANUAL
    R"(  --json [FILE]        the same as one JSON object, on standard output or in a file

examples:
  tinsmith info dem.tif
  tinsmith info @tiles.txt
  tinsmith info dem.glb --json

exit codes: 0 done; 2 wrong usage; 3 the file can't be used; 4 the JSON can't be written; 5 out of memory
)";

struct Flags {
  std::string file;
  InputFlags input;
  std::string json;
};

int say_what_is_in(const Flags& flags) {
  const InputOptions options = to_input_options(flags.input);
  require_apart({flags.json}, files_read({flags.file}));
  const auto entries = describe(flags.file, options);
  if (!flags.json.empty()) {
    Json object;
    object["file"] = flags.file;
    for (const auto& [name, value] : entries) object[name] = value;
    write_json(object, flags.json);
    return 0;
  }
  for (const auto& [name, value] : entries) std::printf("%-14s %s\n", name.c_str(), in_one_line(value).c_str());
  return 0;
}

}  // namespace

void add_info(CLI::App& program, Run& run) {
  CLI::App& verb = *program.add_subcommand("info");
  set_manual(verb, kManual);
  auto flags = std::make_shared<Flags>();
  verb.add_option("FILE", flags->file)->required();
  add_input_flags(verb, flags->input);
  verb.add_option("--json", flags->json)->expected(0, 1)->default_str("-");
  verb.callback([flags, &run] { run = [flags] { return say_what_is_in(*flags); }; });
}

}  // namespace tinsmith::cli
