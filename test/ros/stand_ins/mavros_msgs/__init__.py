"""What tests need of MAVROS's messages, which may not be installed."""
