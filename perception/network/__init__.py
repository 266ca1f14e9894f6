"""The panoptic scene graph network: any ONNX file that keeps the contract in docs/network.md."""
