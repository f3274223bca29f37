namespace axiscal {}
