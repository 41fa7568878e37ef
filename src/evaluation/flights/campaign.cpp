#include "evaluation/flights/campaign.hpp"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <exception>
#include <mutex>
#include <thread>

namespace window_ingress::evaluation {
namespace {

std::optional<std::uint32_t> parseNumber(const std::string& text) {
  if (text.empty() || text.size() > 9 || text.find_first_not_of("0123456789") != std::string::npos)
    return std::nullopt;
  return static_cast<std::uint32_t>(std::strtoul(text.c_str(), nullptr, 10));
}

/// Gives seeds to threads and passes results on in order.
class Queue {
 public:
  Queue(const std::vector<std::uint32_t>& seeds, const Fly& fly, const Report& report)
      : seeds_(seeds), fly_(fly), report_(report), results_(seeds.size()) {}

  void work() {
    while (!failed_) {
      const std::size_t index = next_++;
      if (index >= seeds_.size()) return;
      try {
        deliver(index, fly_(seeds_[index]));
      } catch (...) {
        fail();
      }
    }
  }
  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  void deliver(std::size_t index, FlightResult result) {
    const std::lock_guard<std::mutex> lock(mutex_);
    results_[index] = std::move(result);
    for (; reported_ < results_.size() && results_[reported_]; ++reported_) {
      report_(*results_[reported_], static_cast<int>(reported_ + 1), static_cast<int>(seeds_.size()));
    }
  }
  void fail() {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!error_) error_ = std::current_exception();
    failed_ = true;
  }

  const std::vector<std::uint32_t>& seeds_;
  const Fly& fly_;
  const Report& report_;
  std::atomic<std::size_t> next_{0};
  std::atomic<bool> failed_{false};
  std::mutex mutex_;
  std::vector<std::optional<FlightResult>> results_;
  std::size_t reported_ = 0;
  std::exception_ptr error_;
};

}  // namespace

std::optional<std::vector<std::uint32_t>> parseSeeds(const std::string& text) {
  const auto dots = text.find("..");
  const auto first = parseNumber(text.substr(0, dots));
  const auto last = dots == std::string::npos ? first : parseNumber(text.substr(dots + 2));
  if (!first || !last || *last < *first || *last - *first >= 1000000) return std::nullopt;
  std::vector<std::uint32_t> seeds;
  for (std::uint32_t seed = *first; seed <= *last; ++seed) seeds.push_back(seed);
  return seeds;
}

std::optional<std::vector<std::uint32_t>> shardOf(const std::vector<std::uint32_t>& seeds,
                                                  const std::string& text) {
  const auto slash = text.find('/');
  if (slash == std::string::npos) return std::nullopt;
  const auto which = parseNumber(text.substr(0, slash)), of = parseNumber(text.substr(slash + 1));
  if (!which || !of || *which < 1 || *which > *of) return std::nullopt;
  std::vector<std::uint32_t> shard;
  for (std::size_t i = *which - 1; i < seeds.size(); i += *of) shard.push_back(seeds[i]);
  return shard;
}

std::string seedsText(const std::vector<std::uint32_t>& seeds) {
  std::string text;
  for (std::size_t i = 0; i < seeds.size();) {
    std::size_t last = i;
    while (last + 1 < seeds.size() && seeds[last + 1] == seeds[last] + 1) ++last;
    text += (i == 0 ? "" : ", ") + std::to_string(seeds[i]);
    if (last > i) text += ".." + std::to_string(seeds[last]);
    i = last + 1;
  }
  return text;
}

void flyAll(const std::vector<std::uint32_t>& seeds, int jobs, const Fly& fly, const Report& report) {
  Queue queue(seeds, fly, report);
  const int workers = std::max(1, std::min(jobs, static_cast<int>(seeds.size())));
  std::vector<std::thread> threads;
  for (int i = 1; i < workers; ++i) threads.emplace_back([&queue] { queue.work(); });
  queue.work();
  for (auto& thread : threads) thread.join();
  queue.rethrow();
}

}  // namespace window_ingress::evaluation
