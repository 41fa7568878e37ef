#include "adapters/runtime/console_decoupling.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <mutex>

namespace window_ingress::adapters {
namespace {

// Otherwise this process would keep open what others expect to close when the node dies.
void closeAllBut(int one, int other) {
  DIR* const all = opendir("/proc/self/fd");
  if (all == nullptr) return;
  while (const dirent* entry = readdir(all)) {
    const int descriptor = std::atoi(entry->d_name);
    if (entry->d_name[0] != '.' && descriptor != one && descriptor != other && descriptor != dirfd(all))
      close(descriptor);
  }
  closedir(all);
}

void ignoreSignals() {
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE, SIGTTOU}) std::signal(number, SIG_IGN);
}

// Another owner may have made the descriptor non-blocking.
bool mayTryAgain(int descriptor) {
  if (errno == EINTR) return true;
  if (errno != EAGAIN) return false;
  pollfd waiting{descriptor, POLLOUT, 0};
  poll(&waiting, 1, -1);
  return true;
}

// Output that cannot be written (full disk, closed terminal) is lost.
void writeAll(int descriptor, const char* data, ssize_t size) {
  while (size > 0) {
    const ssize_t written = write(descriptor, data, static_cast<size_t>(size));
    if (written < 0 && !mayTryAgain(descriptor)) return;
    if (written < 0) continue;
    data += written;
    size -= written;
  }
}

[[noreturn]] void passOn(int from, int to) {
  ignoreSignals();
  closeAllBut(from, to);
  std::array<char, 4096> chunk{};
  for (;;) {
    const ssize_t size = read(from, chunk.data(), chunk.size());
    if (size == 0 || (size < 0 && errno != EINTR)) _exit(0);
    if (size > 0) writeAll(to, chunk.data(), size);
  }
}

}  // namespace

void decoupleOutput(int descriptor) {
  int ends[2];
  if (pipe(ends) != 0) return;
  const auto [out, in] = ends;
  const pid_t child = fork();
  if (child == 0) passOn(out, descriptor);
  if (child > 0 && fcntl(in, F_SETFL, O_NONBLOCK) == 0) dup2(in, descriptor);
  close(in);
  close(out);
}

void decoupleConsole() {
  static std::once_flag once;
  std::call_once(once, [] {
    std::signal(SIGPIPE, SIG_IGN);
    decoupleOutput(STDOUT_FILENO);
    decoupleOutput(STDERR_FILENO);
    std::setvbuf(stdout, nullptr, _IOLBF, 0);  // line buffering, as on a terminal
  });
}

bool consoleIsStuck() {
  std::array<pollfd, 2> outputs{pollfd{STDOUT_FILENO, POLLOUT, 0}, pollfd{STDERR_FILENO, POLLOUT, 0}};
  if (poll(outputs.data(), outputs.size(), 0) < 0) return false;
  return outputs[0].revents == 0 || outputs[1].revents == 0;
}

}  // namespace window_ingress::adapters
