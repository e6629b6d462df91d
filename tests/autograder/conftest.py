def pytest_configure(config):
    config.addinivalue_line("markers", "audit: grades every known submission, which takes minutes")
