"""Chapter 4: a service and an action of one's own, as definitions that build."""

FILES = ("GetBatteryStatus.srv", "NavigateToPose.action")
