#include "interrupt.hpp"

#include <csignal>

namespace tinsmith::cli {
namespace {

volatile std::sig_atomic_t interrupted = 0;

}  // namespace

void catch_signals() {
  struct sigaction remember {};
  remember.sa_handler = [](int) { interrupted = 1; };
  remember.sa_flags = SA_RESTART;
  sigaction(SIGINT, &remember, nullptr);
  sigaction(SIGTERM, &remember, nullptr);
  struct sigaction ignore {};
  ignore.sa_handler = SIG_IGN;
  sigaction(SIGXFSZ, &ignore, nullptr);
}

bool is_interrupted() { return interrupted != 0; }

}  // namespace tinsmith::cli
