#pragma once

namespace window_ingress::detection {

struct TrackParams {
  double reach = 0.0094;        ///< furthest a border may lie from where it is predicted [longer image sides]
  int profiles = 18;            ///< across each side to find the border again
  int fine_profiles = 40;       ///< across each side to fit its line
  double min_similarity = 0.5;  ///< correlation of a side's profile with the remembered one, 0 to 1
  double min_inliers = 0.4;     ///< part of a side's profiles that must lie on its line
  double min_stretch =
      0.06;  ///< shortest part of a side in the picture that is a border [longer image sides]
  double min_certainty = 0.4;  ///< below this the track is given up and the window searched, 0 to 1
  double max_shape_change =
      0.06;            ///< of aspect, skew and keystone between frames beyond the prediction [sides]
  double turn = 0.12;  ///< unforeseen motion of the window's place without attitude [longer image sides/s]
  double turn_known = 0.06;      ///< the same with attitude at both exposures [longer image sides/s]
  double reshape = 0.25;         ///< unforeseen change of its size and roll [window sides/s]
  double warp = 0.08;            ///< unforeseen change of aspect, skew and keystone [window sides/s]
  double max_gap_sec = 0.5;      ///< pictures further apart start anew [s]
  double reacquire_sec = 0.6;    ///< a lost window found again in its place within this time is the same [s]
  double reacquire_gate = 0.35;  ///< furthest from its place to be the same [window sides]
  int settled = 5;            ///< frames after which a lost window is waited for before another one is taken
  int appearance_every = 15;  ///< frames between comparisons with the reference
  double adaptation = 0.1;    ///< part of a difference in appearance that such a comparison takes over
  double likeness_margin =
      0.2;  ///< a window less like the reference than the target was by this is another one
  double likeness_sec = 10.0;    ///< so long after the target was last compared [s]
  double adapt_certainty = 0.8;  ///< only above this the reference follows the light, 0 to 1
  int confirmations =
      3;  ///< searches that must agree with a new track, or name another place, to be believed
  int question_every = 2;   ///< frames between such searches
  double survey_sec = 1.0;  ///< between looks for all windows in view, while one is followed; 0: none [s]

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("reach", self.reach, 0.002, 0.1);
    field("profiles", self.profiles, 6, 200);
    field("fine_profiles", self.fine_profiles, 6, 400);
    field("min_similarity", self.min_similarity, 0.0, 1.0);
    field("min_inliers", self.min_inliers, 0.0, 1.0);
    field("min_stretch", self.min_stretch, 0.01, 0.5);
    field("min_certainty", self.min_certainty, 0.0, 1.0);
    field("max_shape_change", self.max_shape_change, 0.001, 1.0);
    field("turn", self.turn, 0.001, 10.0);
    field("turn_known", self.turn_known, 0.001, 10.0);
    field("reshape", self.reshape, 0.001, 10.0);
    field("warp", self.warp, 0.001, 10.0);
    field("max_gap_sec", self.max_gap_sec, 0.01, 60.0);
    field("reacquire_sec", self.reacquire_sec, 0.0, 60.0);
    field("reacquire_gate", self.reacquire_gate, 0.01, 0.5);
    field("settled", self.settled, 1, 1000);
    field("appearance_every", self.appearance_every, 1, 100000);
    field("adaptation", self.adaptation, 0.0, 1.0);
    field("likeness_margin", self.likeness_margin, 0.01, 1.0);
    field("likeness_sec", self.likeness_sec, 0.0, 1000.0);
    field("adapt_certainty", self.adapt_certainty, 0.0, 1.0);
    field("confirmations", self.confirmations, 1, 100);
    field("question_every", self.question_every, 1, 1000);
    field("survey_sec", self.survey_sec, 0.0, 60.0);
  }
};

}  // namespace window_ingress::detection
