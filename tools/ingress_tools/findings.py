"""What doctor found: causes, each with what follows from it and what mends it."""
import os


def as_run(text, launch=None):
    """A mend as who runs doctor has to type it: by scripts/run as they called it, else in a sourced workspace."""
    if launch:
        text = text.replace("ingress.launch", launch)
    run = os.environ.get("WINDOW_INGRESS_RUN", "")
    return text.replace("scripts/run ", f"{run} " if run else "").replace("scripts/ingress ", f"{run[:-len('run')]}ingress ")


class Finding:
    """Something that is wrong. `stage` is that of the first node of the pipeline that suffers from it; a symptom has its cause
    before that, if anything is wrong there."""

    def __init__(self, level, text, mend, stage=0, symptom=False):
        self.level, self.text, self.mend, self.stage, self.symptom = level, text, mend, stage, symptom
        self.follows = []


class Report:
    """Findings: those that are causes, in the order of the pipeline, each with what follows from it."""

    def __init__(self):
        self.findings = []
        self.named = set()  # topics and nodes that something was said about
        self.launch = None  # the file that was launched, where that can be told

    def ok(self, text):
        print(f"OK     {text}", flush=True)

    def warn(self, text, mend, about=(), **place):
        self._add("WARN", text, mend, about, place)

    def error(self, text, mend, about=(), **place):
        self._add("ERROR", text, mend, about, place)

    def _add(self, level, text, mend, about, place):
        self.named.update(filter(None, about))
        self.findings.append(Finding(level, text, mend, **place))

    def causes(self):
        """Those with what follows from them; a symptom without anything wrong before it is a cause, too."""
        ordered = sorted(self.findings, key=lambda finding: (finding.level != "ERROR", finding.stage, finding.symptom))
        causes = []
        for finding in ordered:
            before = [cause for cause in causes if cause.level == "ERROR" and cause.stage <= finding.stage]
            if finding.symptom and before:
                before[-1].follows.append(finding)
            else:
                causes.append(finding)
        return causes

    def say(self):
        """\return how many there are"""
        causes = self.causes()
        for cause in causes:
            print(f"{cause.level:5s}  {cause.text}\n       mend: {as_run(cause.mend, self.launch)}", flush=True)
            for finding in cause.follows:
                print(f"       follows: {finding.text}", flush=True)
        following = len(self.findings) - len(causes)
        print(f"{len(causes)} finding(s) to mend" + (f", {following} follow from them" if following else "") if causes
              else "nothing is wrong", flush=True)
        return len(causes)
