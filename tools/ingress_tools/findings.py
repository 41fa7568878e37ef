"""Findings of doctor: causes, each with its consequences and its remedy."""
import os


def as_run(text, launch=None):
    """A remedy as the user has to type it: with scripts/run as they called it, else in a sourced workspace."""
    if launch:
        text = text.replace("ingress.launch", launch)
    if launch == "sim.launch":  # its scenario has what the other launch files have as arguments
        text = text.replace("window_size:=W,H, or homography_pose/pose/opening_*_m in your config", "another homography_pose/pose/opening_*_m in the file of config:=")
        text = text.replace("camera_pose:=x,y,z,yaw,pitch,roll", "another camera: {told_yaw_error_rad, told_pitch_error_rad} in the scenario")
    run = os.environ.get("WINDOW_INGRESS_RUN", "")
    return text.replace("scripts/run ", f"{run} " if run else "").replace("scripts/ingress ", f"{run[:-len('run')]}ingress ")


class Finding:
    """Something that is wrong. `stage` is the first stage of the pipeline that suffers from it. A symptom has its cause at or
    before that stage, if an error is there."""

    def __init__(self, level, text, mend, stage=0, symptom=False):
        self.level, self.text, self.mend, self.stage, self.symptom = level, text, mend, stage, symptom
        self.follows = []


class Report:
    """Collects findings; prints causes in the order of the pipeline, each with its consequences."""

    def __init__(self):
        self.findings = []
        self.named = set()  # topics and nodes that findings are about
        self.launch = None  # the launch file, if known

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
        """Causes with their consequences. A symptom without an error before it is a cause, too."""
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
        """Prints all findings. \return the number of causes"""
        causes = self.causes()
        for cause in causes:
            print(f"{cause.level:5s}  {cause.text}\n       mend: {as_run(cause.mend, self.launch)}", flush=True)
            for finding in cause.follows:
                print(f"       follows: {finding.text}", flush=True)
        following = len(self.findings) - len(causes)
        print(f"{len(causes)} finding(s) to mend" + (f", {following} follow from them" if following else "") if causes
              else "nothing is wrong", flush=True)
        return len(causes)
