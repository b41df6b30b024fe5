"""From one bag to a fleet: bags by the thousand into a database, and what it says of every strut. doc/fleet.md"""
