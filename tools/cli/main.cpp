// tinsmith: DEM rasters into TINs with a certified error. The first word names the verb.

#include <cstdio>
#include <exception>
#include <new>
#include <string>

#include "base/machine_memory.hpp"
#include "interrupt.hpp"
#include "text.hpp"
#include "tinsmith/error.hpp"
#include "tinsmith/version.hpp"
#include "verbs.hpp"

namespace tinsmith::cli {
namespace {

constexpr const char* kManual =
    R"(tinsmith: compresses terrain into triangles, with a certificate of the largest error.

usage: tinsmith VERB ARGUMENTS...

  compress   DEM rasters into a TIN (triangulated irregular network) within a tolerance
  verify     measures a TIN against every sample of the DEM, anew
  render     hillshade, wireframe and error map as a PNG
  info       what is in a raster or mesh file
  simplify   any triangle mesh (scan, model, coloured terrain) with fewer triangles

  tinsmith VERB --help   the manual of a verb, with examples
  tinsmith --version

example:
  tinsmith compress dem.tif dem.ply --max-error 10
  tinsmith verify dem.tif dem.ply --max-error 10
  tinsmith render dem.tif dem.ply dem.png
  tinsmith simplify scan.ply small.ply --ratio 0.05

Rasters are whatever GDAL reads. Meshes are .ply, .obj, .glb (glTF 2.0) and .2dm; simplify takes and makes .ply,
.obj, .stl and .glb. Results go to standard output, progress and complaints to standard error. A file appears under
its name only when it is whole; a run that fails leaves what stood there before.

exit codes: 0 done; 1 the result does not hold; 2 wrong usage; 3 an input can't be used; 4 an output can't be
written; 5 memory or a format's limit does not suffice; 130 interrupted
)";

constexpr int kWrongUsage = 2;
constexpr int kNoResources = 5;

int complain(const std::string& what, int exit_code) {
  std::fprintf(stderr, "tinsmith: %s\n", in_one_line(what).c_str());
  return exit_code;
}

// Help and version are exceptions to CLI11; everything else that it throws is wrong usage.
int answer(const CLI::App& program, const CLI::ParseError& error, const std::string& first_word) {
  if (error.get_exit_code() == 0) return program.exit(error);
  const auto verbs = program.get_subcommands();
  if (verbs.empty())
    return complain((first_word.empty() ? "what to do?" : first_word + ": no such verb;") +
                        " there are compress, verify, render, info and simplify; see tinsmith --help",
                    kWrongUsage);
  const std::string verb = verbs.front()->get_name() + " ";
  return complain(std::string(error.what()) + "; see tinsmith " + verb + "--help", kWrongUsage);
}

// What each verb can do about its memory.
const char* way_to_less_memory(const std::string& verb) {
  if (verb == "compress") return "use a smaller --window, fewer --threads, less --memory or a machine with more";
  if (verb == "verify") return "use fewer --threads, less --memory or a machine with more";
  if (verb == "render") return "draw a smaller picture or --bbox, or use a machine with more";
  return "use a machine with more";
}

int run_program(int argc, char** argv) {
  keep_freed_memory();
  begin_heap_with_huge_pages();
  CLI::App program("", "tinsmith");
  set_manual(program, kManual);
  program.set_version_flag("--version", std::string("tinsmith ") + version());
  program.require_subcommand(1);
  Run run;
  add_compress(program, run);
  add_verify(program, run);
  add_render(program, run);
  add_info(program, run);
  add_simplify(program, run);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return answer(program, error, argc > 1 ? argv[1] : "");
  }
  catch_signals();
  const int exit_code = run();
  require_written_results();
  return exit_code;
}

}  // namespace
}  // namespace tinsmith::cli

int main(int argc, char** argv) {
  using tinsmith::cli::complain;
  try {
    return tinsmith::cli::run_program(argc, argv);
  } catch (const tinsmith::Error& error) {
    return complain(error.what(), error.exit_code());
  } catch (const std::bad_alloc&) {
    return complain(std::string("out of memory; ") + tinsmith::cli::way_to_less_memory(argc > 1 ? argv[1] : ""),
                    tinsmith::cli::kNoResources);
  } catch (const std::exception& error) {
    return complain(std::string("unexpected failure: ") + error.what() + "; please report it",
                    tinsmith::cli::kNoResources);
  }
}
