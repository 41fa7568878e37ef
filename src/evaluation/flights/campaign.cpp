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
  std::atomic<std::size_t> next{0};
  std::atomic<bool> failed{false};
  std::mutex mutex;  // of all that follows
  std::exception_ptr error;
  std::vector<std::optional<FlightResult>> results(seeds.size());
  std::size_t reported = 0;
  const auto work = [&] {
    for (std::size_t i = next++; i < seeds.size() && !failed; i = next++) {
      try {
        FlightResult result = fly(seeds[i]);
        const std::lock_guard<std::mutex> lock(mutex);
        results[i] = std::move(result);
        for (; reported < results.size() && results[reported]; ++reported)
          report(*results[reported], static_cast<int>(reported + 1), static_cast<int>(seeds.size()));
      } catch (...) {
        const std::lock_guard<std::mutex> lock(mutex);
        if (!error) error = std::current_exception();
        failed = true;
      }
    }
  };
  std::vector<std::thread> threads;
  const int workers = std::min(jobs, static_cast<int>(seeds.size()));
  for (int i = 1; i < workers; ++i) threads.emplace_back(work);
  work();
  for (auto& thread : threads) thread.join();
  if (error) std::rethrow_exception(error);
}

}  // namespace window_ingress::evaluation
