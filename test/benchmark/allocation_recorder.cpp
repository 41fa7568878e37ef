#include "allocation_recorder.hpp"

#include <cxxabi.h>
#include <dlfcn.h>
#include <execinfo.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <map>
#include <memory>

namespace window_ingress::bench {
namespace {

constexpr int kDepth = 40;

struct Stack {
  std::array<void*, kDepth> frames;
  int depth;
};

std::array<Stack, 1 << 17> stacks;  // untouched pages cost nothing
std::size_t taken = 0, overflow = 0, bytes = 0;
bool recording = false;

void note(std::size_t size) {
  if (!recording) return;
  recording = false;  // the stack walk may allocate memory itself
  bytes += size;
  if (taken < stacks.size()) {
    stacks[taken].depth = backtrace(stacks[taken].frames.data(), kDepth);
    ++taken;
  } else {
    ++overflow;
  }
  recording = true;
}

struct Frame {
  std::string library, function;  ///< function is empty if the library does not name it
};

std::string demangled(const char* symbol) {
  int status = 0;
  const std::unique_ptr<char, decltype(&std::free)> text(
      abi::__cxa_demangle(symbol, nullptr, nullptr, &status), &std::free);
  return text ? text.get() : symbol;
}

Frame resolve(void* address) {
  Dl_info info;
  if (!dladdr(address, &info)) return {};
  const std::string path = info.dli_fname;
  return {path.substr(path.rfind('/') + 1), info.dli_sname ? demangled(info.dli_sname) : ""};
}

/// Resolving is slow, and the same addresses repeat.
const Frame& frameAt(void* address) {
  static std::map<void*, Frame> known;
  const auto found = known.find(address);
  return found != known.end() ? found->second : known.emplace(address, resolve(address)).first->second;
}

bool has(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

/// The C and C++ libraries, and this program, which only measures but holds copies of templates.
bool isRuntime(const Frame& frame) {
  for (const char* name : {"libc.", "libstdc++", "benchmark_"})
    if (frame.library.rfind(name, 0) == 0) return true;
  return false;
}

/// Templates of the standard library and of Eigen count for their caller, wherever they were compiled.
bool isTemplate(const Frame& frame) {
  const std::string head = frame.function.substr(0, frame.function.find('('));
  return head.rfind("std::", 0) == 0 || has(head, " std::") || has(head, "__gnu_cxx::") ||
         head.rfind("Eigen::", 0) == 0 || has(head, " Eigen::");
}

bool isOurs(const Frame& frame) { return has(frame.library, "window_ingress"); }
bool isOpencv(const Frame& frame) { return has(frame.library, "opencv"); }

/// Functions of OpenCV that only allocate what their caller asks for.
bool makesRoom(const std::string& function) {
  for (const char* name : {"cv::Mat::", "cv::fastMalloc", "cv::MatAllocator", "cv::Mat_<", "cv::AutoBuffer"})
    if (function.rfind(name, 0) == 0) return true;
  return false;
}

/// The name without arguments and without our own name spaces.
std::string shortName(std::string name) {
  for (const char* part : {"window_ingress::", "detection::", "(anonymous namespace)::"})
    for (std::size_t at; (at = name.find(part)) != std::string::npos;) name.erase(at, std::strlen(part));
  return name.substr(0, name.find('('));
}

/// The frames between the allocation and the benchmark, innermost first.
std::vector<const Frame*> meaningful(const Stack& stack) {
  std::vector<const Frame*> frames;
  for (int i = 0; i < stack.depth; ++i) {
    const Frame& frame = frameAt(stack.frames[i]);
    if (!isRuntime(frame) && !isTemplate(frame)) frames.push_back(&frame);
  }
  return frames;
}

/// The last function that is called from outside its library, or the nearest inner one with a name.
std::string nameOf(const std::vector<const Frame*>& frames, std::size_t begin, std::size_t end) {
  for (std::size_t i = end; i-- > begin;)
    if (!frames[i]->function.empty()) return shortName(frames[i]->function);
  return frames[end - 1]->library;
}

/// Our local functions count as the function that calls them.
std::string ourName(const std::vector<const Frame*>& frames, std::size_t from) {
  for (std::size_t i = from; i < frames.size(); ++i)
    if (!frames[i]->function.empty()) return (i > from ? "local in " : "") + shortName(frames[i]->function);
  return "local";
}

AllocationSite siteOf(const Stack& stack) {
  const auto frames = meaningful(stack);
  if (frames.empty()) return {Whose::kOther, "benchmark"};
  std::size_t ours = 0;
  while (ours < frames.size() && !isOurs(*frames[ours])) ++ours;
  const std::string caller = ourName(frames, ours);
  if (ours == 0) return {Whose::kOurs, caller};
  const Frame& called = *frames[ours - 1];
  const Whose whose = isOpencv(called) ? Whose::kOpencv : Whose::kOther;
  if (ours == frames.size()) return {whose, nameOf(frames, 0, ours)};
  const std::string name = nameOf(frames, 0, ours);
  if (whose == Whose::kOpencv && makesRoom(name)) return {Whose::kOurs, "cv::Mat in " + caller};
  return {whose, name + " < " + caller};
}

}  // namespace

const char* toString(Whose whose) {
  return whose == Whose::kOurs ? "ours" : whose == Whose::kOpencv ? "opencv" : "other";
}

void startRecording() {
  std::array<void*, kDepth> unused;
  backtrace(unused.data(), kDepth);  // loads the unwinder
  taken = overflow = bytes = 0;
  recording = true;
}

Recording stopRecording() {
  recording = false;
  Recording result;
  for (std::size_t i = 0; i < taken; ++i) result.sites.push_back(siteOf(stacks[i]));
  result.overflow = overflow;
  result.bytes = bytes;
  return result;
}

}  // namespace window_ingress::bench

// The C library's own functions, under the names that it exports for replacements.
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* old, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

void* malloc(std::size_t size) {
  window_ingress::bench::note(size);
  return __libc_malloc(size);
}

void* calloc(std::size_t count, std::size_t size) {
  window_ingress::bench::note(count * size);
  return __libc_calloc(count, size);
}

void* realloc(void* old, std::size_t size) {
  window_ingress::bench::note(size);
  return __libc_realloc(old, size);
}

void* memalign(std::size_t alignment, std::size_t size) {
  window_ingress::bench::note(size);
  return __libc_memalign(alignment, size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size) { return memalign(alignment, size); }

int posix_memalign(void** result, std::size_t alignment, std::size_t size) {
  *result = memalign(alignment, size);
  return *result ? 0 : ENOMEM;
}
}
