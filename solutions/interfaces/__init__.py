"""Chapter 4: definitions of a custom service and a custom action, which must build."""

FILES = ("GetBatteryStatus.srv", "NavigateToPose.action")
