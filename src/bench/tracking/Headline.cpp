#include "bench/tracking/Headline.h"

#include "bench/tracking/Accuracy.h"

namespace heft {

namespace {
FilmPlan plan_for(int width_px, Motion motion, bool quick) {
  FilmPlan plan{width_px, motion, 1, 12, 2, Grip::any};
  if (quick) return plan;
  const int share = width_px == 640 ? 2 : 1;
  plan.n_takes = motion == Motion::hold ? 10 * share : 20 * share;
  plan.n_pictures = motion == Motion::swipe ? 15 : 30;
  return plan;
}
}  // namespace

Headline film_headline(int width_px, bool quick, StudyProgress& progress) {
  Headline headline;
  headline.width_px = width_px;
  const std::vector methods{our_method(width_px), plain_method(width_px)};
  const auto filmed = [&](Motion motion, const std::string& name) {
    progress.next(name + " at " + size_name(width_px));
    auto films = film(plan_for(width_px, motion, quick), methods);
    return Headline::Pair{std::move(films[0]), std::move(films[1])};
  };
  headline.strokes = filmed(Motion::stroke, "strokes");
  headline.swipes = filmed(Motion::swipe, "swipes");
  headline.holds = filmed(Motion::hold, "holds");
  return headline;
}

}  // namespace heft
