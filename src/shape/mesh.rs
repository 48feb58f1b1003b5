unsafe {}
