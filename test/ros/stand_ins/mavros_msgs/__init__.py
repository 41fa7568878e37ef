"""The parts of MAVROS's messages that tests need; MAVROS may not be installed."""
