// SPDX-License-Identifier: BSD-3-Clause
// Voting with every edge point of the scene as a reference, so that the votes can be counted: those that are really
// cast, the entries of the buckets of all pairs. Voting and VotingByHashMap are whole searches, features and peaks
// included; CastVotes and Peaks are what they name.
#include "BenchmarkScene.h"

#include "base/PointGrid.h"
#include "pose/voting/VoteAccumulator.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>

namespace
{
using Votes = std::vector<meam::VoteBucket>;
using scenes::SearchOf;

/// What the pairs of a reference point vote for, looked up among the points that detectPoses looks at.
class Pairs
{
public:
  explicit Pairs(const scenes::Search& search)
    : Searched(search)
    , References(search.edges().cloud)
    , Referred(this->References.subset(meam::thinPoints(this->References.points, search.model.votingLeaf())))
    , Grid(this->Referred.points, 0.25 * search.model.diameter)
    , Blocks(this->Referred.points)
    , Keys(this->Referred.subset(this->Blocks.order()).points, this->Referred.subset(this->Blocks.order()).tangents,
        search.model.quantizer())
  {
  }

  const meam::PointCloud& references() const { return this->References; }
  const meam::PointCloud& referred() const { return this->Referred; }

  meam::PairFrame reference(std::size_t r) const
  {
    return { this->References.points[r], this->References.tangents[r] };
  }

  template <typename Visitor>
  void forEach(const meam::PairFrame& reference, Visitor&& visit) const
  {
    this->Grid.forEachRange(reference.Origin, this->Searched.model.diameter,
      [&](int begin, int end)
      {
        for (; begin < end; ++begin)
        {
          visit(this->Grid.order()[begin]);
        }
      });
  }

  Votes of(const meam::PairFrame& reference) const
  {
    Votes votes;
    const std::vector<int> blocks = this->Blocks.within(reference.Origin, this->Searched.model.diameter);
    std::vector<int> keys(blocks.size() * meam::BlockedPoints::Size);
    std::vector<meam::PairTurn> turns(keys.size());
    this->Keys.compute(reference, blocks.data(), static_cast<int>(blocks.size()), keys.data(), turns.data());
    const std::vector<std::uint32_t>& offsets = this->Searched.model.table.offsets;
    for (std::size_t k = 0; k < keys.size(); ++k)
    {
      if (keys[k] >= 0 && offsets[keys[k]] < offsets[keys[k] + 1])
      {
        votes.push_back({ offsets[keys[k]], offsets[keys[k] + 1], turns[k] });
      }
    }
    return votes;
  }

private:
  const scenes::Search& Searched;
  meam::PointCloud References;
  meam::PointCloud Referred;
  meam::PointGrid Grid;
  meam::BlockedPoints Blocks;
  meam::PairKeys Keys;
};

double numberOf(const Votes& votes)
{
  return std::accumulate(votes.begin(), votes.end(), 0.0,
    [](double sum, const meam::VoteBucket& bucket) { return sum + (bucket.end - bucket.begin); });
}

/// All votes of a search.
struct Cast
{
  double votes = 0.0;
  double buckets = 0.0;
};

Cast castBy(const scenes::Search& search)
{
  const Pairs pairs(search);
  Cast cast;
  for (std::size_t r = 0; r < pairs.references().size(); ++r)
  {
    const Votes votes = pairs.of(pairs.reference(r));
    cast.votes += numberOf(votes);
    cast.buckets += static_cast<double>(votes.size());
  }
  return cast;
}

double angleStep(const scenes::Search& search) { return search.model.settings.angleStep * M_PI / 180.0; }

void detect(benchmark::State& state, const scenes::Search& search, int threads)
{
  meam::PoseDetectionSettings settings;
  settings.referenceShare = 1.0;
  settings.threads = threads;
  const Cast cast = castBy(search);
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(meam::detectPoses(search.edges(), search.model, settings));
  }
  state.counters["votes/s"] = benchmark::Counter(cast.votes, benchmark::Counter::kIsIterationInvariantRate);
  state.counters["votes/bucket"] = cast.votes / cast.buckets;
}

void Voting(benchmark::State& state, SearchOf searchOf)
{
  scenes::withSearch(
    state, searchOf, [&](const scenes::Search& search) { detect(state, search, static_cast<int>(state.range(0))); });
}
BENCHMARK_CAPTURE(Voting, bracket, scenes::bracketSearch)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Voting, tohoku, scenes::tohokuSearch)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);

void VotingByScenePoints(benchmark::State& state)
{
  const scenes::Search search = scenes::searchOfCopies(static_cast<int>(state.range(0)));
  detect(state, search, 1);
  scenes::growsWith(state, search.edges().cloud.size());
}
BENCHMARK(VotingByScenePoints)->ArgsProduct({ scenes::Copies })->UseRealTime()->Unit(benchmark::kMillisecond);

void VotingByModelPoints(benchmark::State& state)
{
  const scenes::Search search = scenes::searchOfThinned(static_cast<int>(state.range(0)));
  detect(state, search, 1);
  scenes::growsWith(state, search.model.table.votingPoints);
}
BENCHMARK(VotingByModelPoints)->ArgsProduct({ scenes::Leaves })->UseRealTime()->Unit(benchmark::kMillisecond);

/// The peer: a hash map from the key to a list of pairs, an angle computed for each vote.
void VotingByHashMap(benchmark::State& state, SearchOf searchOf)
{
  const scenes::Search* search = searchOf();
  if (!search)
  {
    return scenes::skip(state);
  }
  const meam::TrainedModel& model = search->model;
  const meam::PairFeatureQuantizer quantizer = model.quantizer();
  struct Pair
  {
    std::uint32_t reference;
    float angle;
    bool against;
  };
  std::unordered_map<int, std::vector<Pair>> table;
  for (int key = 0; key < quantizer.numberOfKeys(); ++key)
  {
    for (std::uint32_t k = model.table.offsets[key]; k < model.table.offsets[key + 1]; ++k)
    {
      const std::uint32_t r = model.table.references[k];
      const Eigen::Vector3f d = model.edges.points[model.table.referreds[k]] - model.edges.points[r];
      table[key].push_back({ r, model.table.angles[k], model.edges.tangents[r].dot(d) < 0.0f });
    }
  }
  const Pairs pairs(*search);
  const meam::PointCloud& references = pairs.references();
  const meam::PointCloud& referred = pairs.referred();
  const int turns = static_cast<int>(std::lround(2.0 * M_PI / angleStep(*search)));
  std::vector<int> counts;
  std::size_t votes = 0;
  for (auto _ : state)
  {
    for (std::size_t r = 0; r < references.size(); ++r)
    {
      counts.assign(model.table.votingPoints * 2 * turns, 0);
      const meam::PairFrame frame = pairs.reference(r);
      pairs.forEach(frame,
        [&](int i)
        {
          const int key = quantizer.key(meam::pairFeature(
            quantizer.kind(), references.points[r], references.tangents[r], referred.points[i], referred.tangents[i]));
          const auto bucket = table.find(key);
          if (bucket == table.end() || referred.points[i] == references.points[r])
          {
            return;
          }
          const float angle = frame.angleOf(referred.points[i]);
          const bool against = frame.against(referred.points[i]);
          for (const Pair& pair : bucket->second)
          {
            const bool flip = pair.against != against;
            const double alpha = std::fmod((flip ? angle + pair.angle : angle - pair.angle) + 4.0 * M_PI, 2.0 * M_PI);
            ++counts[(pair.reference * 2 + flip) * turns + static_cast<int>(alpha * turns / (2.0 * M_PI)) % turns];
          }
          votes += bucket->second.size();
        });
      benchmark::DoNotOptimize(*std::max_element(counts.begin(), counts.end()));
    }
  }
  state.counters["votes/s"] = benchmark::Counter(static_cast<double>(votes), benchmark::Counter::kIsRate);
}
BENCHMARK_CAPTURE(VotingByHashMap, bracket, scenes::bracketSearch)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(VotingByHashMap, tohoku, scenes::tohokuSearch)->UseRealTime()->Unit(benchmark::kMillisecond);

/// Votes alone: what the pairs of some references vote for is known.
void CastVotes(benchmark::State& state, SearchOf searchOf)
{
  const scenes::Search* search = searchOf();
  if (!search)
  {
    return scenes::skip(state);
  }
  constexpr int references = 50;
  const Pairs pairs(*search);
  std::vector<Votes> votes;
  double cast = 0.0;
  for (int k = 0; k < references; ++k)
  {
    votes.push_back(pairs.of(pairs.reference(k * pairs.references().size() / references)));
    cast += numberOf(votes.back());
  }
  const meam::PairTable& table = search->model.table;
  meam::VoteAccumulator accumulator(search->model.table.votingPoints, angleStep(*search));
  for (auto _ : state)
  {
    for (const Votes& ofOne : votes)
    {
      accumulator.clear();
      accumulator.vote(table.votes.data(), ofOne.data(), static_cast<int>(ofOne.size()), table.mostOfOne);
      benchmark::ClobberMemory();
    }
  }
  state.counters["votes/s"] = benchmark::Counter(cast, benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK_CAPTURE(CastVotes, bracket, scenes::bracketSearch)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(CastVotes, tohoku, scenes::tohokuSearch)->Unit(benchmark::kMillisecond);

void findPeaks(benchmark::State& state, const scenes::Search& search, int peaks)
{
  const Pairs pairs(search);
  const Votes votes = pairs.of(pairs.reference(0));
  const meam::PairTable& table = search.model.table;
  meam::VoteAccumulator accumulator(search.model.table.votingPoints, angleStep(search));
  accumulator.vote(table.votes.data(), votes.data(), static_cast<int>(votes.size()), table.mostOfOne);
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(accumulator.peaks(peaks));
  }
  const double bins = search.model.table.votingPoints * 2.0 * 2.0 * M_PI / angleStep(search);
  state.counters["bins/s"] =
    benchmark::Counter(bins * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}

/// The argument is how many peaks; of Threads each finds all of them.
void Peaks(benchmark::State& state, SearchOf searchOf)
{
  scenes::withSearch(
    state, searchOf, [&](const scenes::Search& search) { findPeaks(state, search, static_cast<int>(state.range(0))); });
}
void oneAndTwo(benchmark::internal::Benchmark* peaks)
{
  peaks->Arg(1)->Arg(2)->Threads(1)->Threads(2)->UseRealTime()->Unit(benchmark::kMicrosecond);
}
BENCHMARK_CAPTURE(Peaks, bracket, scenes::bracketSearch)->Apply(oneAndTwo);
BENCHMARK_CAPTURE(Peaks, tohoku, scenes::tohokuSearch)->Apply(oneAndTwo);

void PeaksByModelPoints(benchmark::State& state)
{
  const scenes::Search search = scenes::searchOfThinned(static_cast<int>(state.range(0)));
  findPeaks(state, search, 1);
  scenes::growsWith(state, search.model.table.votingPoints);
}
BENCHMARK(PeaksByModelPoints)->ArgsProduct({ scenes::Leaves })->Unit(benchmark::kMicrosecond);
}
