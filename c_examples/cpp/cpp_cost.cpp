// What accuracy costs in time, through the C++ face: the list, a choice, and its clump.
#include <cstdio>
#include <morula.hpp>
#include <stdexcept>

static int made = 0, failed = 0;
#define CHECK(condition)                                                           \
  do {                                                                             \
    ++made;                                                                        \
    if (!(condition)) {                                                            \
      ++failed;                                                                    \
      std::fprintf(stderr, "%s:%d: not so: %s\n", __FILE__, __LINE__, #condition); \
    }                                                                              \
  } while (0)

int main() {
  const morula::Solid solid(morula::Shape::from_primitive("stone"));
  morula::ClumpOptions how;
  how.effort = MORULA_EFFORT_DRAFT;
  morula::CostOptions options;
  options.most = 20;
  double done = 0;
  const morula::Cost list(solid, how, options, [&](double fraction) {
    CHECK(fraction >= done);
    done = fraction;
    return true;
  });
  const auto points = list.points();
  CHECK(points.size() == list.size() && !list.cut() && done > 0.9);
  CHECK(points.front().spheres == 1 && points.back().spheres == 20);
  morula::CostBounds bounds;
  bounds.goal = MORULA_GOAL_MISMATCH;
  bounds.step_cost = points[5].step_cost;
  const auto choice = list.choose(bounds);
  CHECK(choice.index == 5 && choice.why.find("least mismatch") != std::string::npos);
  std::puts(choice.why.c_str());
  const morula::Clump clump = list.clump(choice.index);
  CHECK(clump.size() == points[5].spheres && clump.overlap().mismatch == points[5].mismatch);
  CHECK(list.choose().index < points.size());
  try {
    list.clump(points.size());
    CHECK(false);
  } catch (const morula::Error &error) {
    CHECK(error.status() == MORULA_STATUS_INDEX_OUT_OF_RANGE);
  }

  // Two grids with two methods; the efforts are their own.
  morula::SweepOver over;
  over.resolutions = {16, 24};
  over.methods = {MORULA_METHOD_BEST, MORULA_METHOD_COVER};
  over.efforts = {MORULA_EFFORT_DRAFT, MORULA_EFFORT_NORMAL};
  options.most = 4;
  done = 0;
  const auto shape = morula::Shape::from_primitive("stone");
  const morula::Sweep sweep(shape, over, {}, how, options, [&](double fraction) {
    CHECK(fraction >= done);
    done = fraction;
    return true;
  });
  const auto lists = sweep.lists();
  CHECK(lists.size() == 4 && sweep.size() == 4 && done > 0.9);
  CHECK(lists[1].resolution == 16 && lists[1].method == MORULA_METHOD_COVER);
  CHECK(lists[2].resolution == 24 && lists[2].effort == MORULA_EFFORT_DRAFT);
  CHECK(lists[0].solid_seconds > 0 && lists[2].cells[0] > lists[0].cells[0]);
  const morula::Cost finer = sweep.curve(2);
  CHECK(finer.points().back().spheres == 4 && finer.size() == lists[2].lines);
  try {
    sweep.curve(4);
    CHECK(false);
  } catch (const morula::Error &error) {
    CHECK(error.status() == MORULA_STATUS_INDEX_OUT_OF_RANGE);
  }
  over.methods.pop_back();
  try {
    morula::Sweep none(shape, over);
    CHECK(false);
  } catch (const morula::Error &error) {
    CHECK(error.status() == MORULA_STATUS_INVALID_ARGUMENT);
  }
  std::printf("%d checks, %d failed\n", made, failed);
  return failed != 0;
}
