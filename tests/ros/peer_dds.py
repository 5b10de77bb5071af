"""Runs with Eclipse Cyclone DDS and no ROS: reads the topics of a bridge. Prints what it saw."""

import json
import os
import sys
import time
from dataclasses import dataclass

# Cyclone DDS finds no match with type objects of Fast DDS 3 (cyclonedds#2184).
os.environ["CYCLONEDDS_URI"] = (
    "<CycloneDDS><Domain><General><Interfaces><NetworkInterface name='lo' multicast='true'/></Interfaces></General>"
    "<Discovery><ParticipantIndex>auto</ParticipantIndex><Peers><Peer address='127.0.0.1'/></Peers></Discovery>"
    "<Compatibility><IgnoreTypeInformation>1.15</IgnoreTypeInformation></Compatibility></Domain></CycloneDDS>"
)

from cyclonedds.core import Policy, Qos
from cyclonedds.domain import DomainParticipant
from cyclonedds.idl import IdlStruct
from cyclonedds.idl.types import float64, int32, sequence, uint32
from cyclonedds.sub import DataReader
from cyclonedds.topic import Topic
from cyclonedds.util import duration


@dataclass
class Time(IdlStruct, typename="builtin_interfaces::msg::dds_::Time_"):
    sec: int32
    nanosec: uint32


@dataclass
class Header(IdlStruct, typename="std_msgs::msg::dds_::Header_"):
    stamp: Time
    frame_id: str


@dataclass
class JointState(IdlStruct, typename="sensor_msgs::msg::dds_::JointState_"):
    header: Header
    name: sequence[str]
    position: sequence[float64]
    velocity: sequence[float64]
    effort: sequence[float64]


@dataclass
class Text(IdlStruct, typename="std_msgs::msg::dds_::String_"):
    data: str


encoding = Policy.DataRepresentation(use_cdrv0_representation=True)
reliable = Policy.Reliability.Reliable(duration(seconds=1))
participant = DomainParticipant(int(os.environ.get("ROS_DOMAIN_ID", "0")))
states = DataReader(
    participant,
    Topic(participant, "rt/joint_states", JointState),
    Qos(reliable, encoding, Policy.History.KeepLast(1000)),
)
texts = DataReader(
    participant,
    Topic(participant, "rt/robot_description", Text),
    Qos(reliable, encoding, Policy.Durability.TransientLocal, Policy.History.KeepLast(1)),
)
found, description, end = [], "", time.monotonic() + 20
while time.monotonic() < end and not (found and description):
    found += states.take(100)
    description = description or next((text.data for text in texts.take(1)), "")
    time.sleep(0.01)
found.clear()
states.take(1000)
end = time.monotonic() + float(sys.argv[1])
while time.monotonic() < end:
    found += states.take(100)
    time.sleep(0.002)
late = [time.time() - 1e-9 * (1e9 * found[-1].header.stamp.sec + found[-1].header.stamp.nanosec)]
print(
    json.dumps(
        {
            "states": len(found),
            "names": list(found[-1].name),
            "q": list(found[-1].position),
            "urdf": "<robot" in description,
            "late": late,
        }
    )
)
