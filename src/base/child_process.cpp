// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The input goes through a socket, because writing to one whose reader has died can be told not to
// raise a signal. Input and output are served in turn as they become ready.
#include "base/child_process.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdlib>

#include "base/files.h"
#include "base/work.h"

extern char** environ;

namespace gable {

namespace {

// The exit status of the dynamic linker when it lacks a library, and of a shell without a program.
constexpr int kCannotRun = 127;

struct Descriptor {
  int fd = -1;
  ~Descriptor() { close(); }
  void close() {
    if (fd >= 0) ::close(fd);
    fd = -1;
  }
};

// Ends and collects the program, if it still runs.
struct Child {
  pid_t pid = -1;
  int wait() {
    int status = 0;
    while (waitpid(pid, &status, 0) < 0 && errno == EINTR) {
    }
    pid = -1;
    return status;
  }
  ~Child() {
    if (pid <= 0) return;
    kill(pid, SIGKILL);
    wait();
  }
};

bool start(Child& child, const std::string& program, const std::vector<std::string>& arguments,
           int in, int out) {
  std::vector<char*> argv{const_cast<char*>(program.c_str())};
  for (const std::string& a : arguments) argv.push_back(const_cast<char*>(a.c_str()));
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, in, 0);
  posix_spawn_file_actions_adddup2(&actions, out, 1);
  posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addclosefrom_np(&actions, 3);
  const int error =
      posix_spawn(&child.pid, program.c_str(), &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) child.pid = -1;
  return error == 0;
}

Error limit(const char* what) {
  return {"child-limit", std::string("the program took more ") + what + " than it may", {}};
}

// Gives and takes until the output ends.
Result<std::string> exchange(Descriptor& in, Descriptor& out, std::string_view input,
                             const ChildLimits& limits) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration<double>(limits.seconds);
  std::string output;
  std::vector<char> buffer(1 << 16);
  for (;;) {
    work();
    if (Clock::now() > end) return limit("time");
    if (input.empty()) in.close();
    pollfd waiting[] = {{out.fd, POLLIN, 0}, {in.fd, POLLOUT, 0}};
    constexpr int kPatience = 50;
    if (poll(waiting, input.empty() ? 1 : 2, kPatience) <= 0) continue;
    if (!input.empty() && waiting[1].revents != 0) {
      const ssize_t sent = send(in.fd, input.data(), input.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
      if (sent > 0) input.remove_prefix(static_cast<size_t>(sent));
      // A program that takes no more may still have something to say.
      if (sent < 0 && errno != EAGAIN && errno != EINTR) input = {};
    }
    if (waiting[0].revents == 0) continue;
    const ssize_t got = read(out.fd, buffer.data(), buffer.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return output;
    if (output.size() + static_cast<size_t>(got) > limits.outputBytes) return limit("output");
    workMemory(static_cast<uint64_t>(got));
    output.append(buffer.data(), static_cast<size_t>(got));
  }
}

}  // namespace

std::string programBeside(const std::string& name) {
  char path[4096];
  const ssize_t n = readlink("/proc/self/exe", path, sizeof path - 1);
  std::vector<std::string> folders;
  if (n > 0) folders.push_back(folderOf(std::string(path, static_cast<size_t>(n))));
  Dl_info info;
  if (dladdr(reinterpret_cast<void*>(&programBeside), &info) != 0 && info.dli_fname) {
    folders.push_back(folderOf(info.dli_fname));
    folders.push_back(folderOf(info.dli_fname) + "../bin/");
  }
  const char* const all = std::getenv("PATH");
  std::string_view rest = all ? all : "";
  while (!rest.empty()) {
    const size_t colon = std::min(rest.find(':'), rest.size());
    if (colon > 0) folders.push_back(std::string(rest.substr(0, colon)) + "/");
    rest.remove_prefix(std::min(colon + 1, rest.size()));
  }
  for (const std::string& folder : folders) {
    if (access((folder + name).c_str(), X_OK) == 0) return folder + name;
  }
  return {};
}

Result<std::string> runChild(const std::string& program, const std::vector<std::string>& arguments,
                             std::string_view input, const ChildLimits& limits) {
  int sockets[2], pipes[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, sockets) != 0) {
    return Error{"child-missing", "no socket can be opened", {}};
  }
  Descriptor in{sockets[0]}, childIn{sockets[1]};
  if (pipe2(pipes, O_CLOEXEC) != 0) return Error{"child-missing", "no pipe can be opened", {}};
  Descriptor out{pipes[0]}, childOut{pipes[1]};
  Child child;
  if (!start(child, program, arguments, childIn.fd, childOut.fd)) {
    return Error{"child-missing", "the program '" + program + "' cannot be started", {}};
  }
  childIn.close();
  childOut.close();
  Result<std::string> output = exchange(in, out, input, limits);
  if (!output.ok()) return output.error();
  const int status = child.wait();
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return output;
  if (WIFEXITED(status) && WEXITSTATUS(status) == kCannotRun) {
    return Error{"child-missing", "the program '" + program + "' lacks a library", {}};
  }
  // What it wrote is why, where it ended by itself.
  const std::string why = WIFEXITED(status) && !output->empty() ? *output : "the reader broke off";
  return Error{"child-failed", why, {}};
}

}  // namespace gable
