#!/usr/bin/env python3
"""Sends Heft's events to a Lab Streaming Layer stream of markers, each a line of JSON.

    pip install pylsl
    python3 lsl_bridge.py 5005 &
    heft run PROTOCOL --participant 07 --events udp:127.0.0.1:5005

Time stamps are those of the events, not of their arrival. The offset between the clocks is the smallest delay
of arrival so far, so that a late datagram does not shift its marker.
"""
import json
import socket
import sys
from datetime import datetime

import pylsl


def main(port):
    info = pylsl.StreamInfo("heft", "Markers", 1, pylsl.IRREGULAR_RATE, "string", f"heft-{port}")
    outlet = pylsl.StreamOutlet(info)
    events = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    events.bind(("127.0.0.1", port))
    offset_s = {}  # from UTC to LSL's clock, by session
    while True:
        line = events.recv(65536).decode().strip()
        arrived_s = pylsl.local_clock()
        event = json.loads(line)
        if event.get("logged"):
            continue  # confirms a line that came before
        utc_s = datetime.fromisoformat(event["utc"].replace("Z", "+00:00")).timestamp()
        key = event["session"]
        offset_s[key] = min(offset_s.get(key, float("inf")), arrived_s - utc_s)
        outlet.push_sample([line], utc_s + offset_s[key])
        print(f"{event['t_s']:10.3f} s  {event['kind']}", file=sys.stderr)


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 5005)
