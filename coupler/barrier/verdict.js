/** What follows from rules: one that is broken fails all, and one that nobody could look at leaves it open. */
const verdict = rules => {
  const count = passes => rules.filter(rule => (rule.passes ?? null) === passes).length;
  const [kept, broken, open] = [true, false, null].map(count);
  const counts = [[kept, "kept"], [broken, "not kept"], [open, "not decided"]].filter(([many]) => many).map(([many, what]) => `${many} ${what}`);
  const because = rules.length ? `Of ${rules.length} ${rules.length === 1 ? "rule" : "rules"}: ${counts.join(", ")}.` : "There are no rules to judge it by.";
  if (broken) return { word: "fails", kind: "bad", because };
  if (open || !rules.length) return { word: "not decided", kind: "warn", because };
  return { word: "passes", kind: "good", because };
};
verdict.ofRule = rule => verdict([rule]);
